#include "batch/leftovers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/atomic_file.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

class LeftoversTest : public ::testing::Test {
 protected:
  void touch(const std::string& name) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "x";
  }

  Store open_store() { return std::move(*Store::open(folder_ / "shoal.db", Store::Access::write)); }

  // As a run does that is killed: the mark stays, the lock does not.
  void leave_mark() {
    Store store = open_store();
    ASSERT_TRUE(RunMark::set(folder_.path(), store));
  }

  void touch_leftovers() {
    for (const auto& name : kLeftovers) touch(name);
  }

  int count_leftovers() {
    return static_cast<int>(std::ranges::count_if(
        kLeftovers, [&](const std::string& name) { return fs::exists(folder_ / name); }));
  }

  TemporaryFolder folder_;
  const std::vector<std::string> kLeftovers = {
      "coefficients.csv" + std::string(kTemporaryMark) + "12-0",
      "maps/a.exr" + std::string(kTemporaryMark) + "12-1",
      "maps/deep/er/b.hdr" + std::string(kTemporaryMark) + "7-99"};
};

TEST_F(LeftoversTest, OnlyTemporaryFilesInTheFoldersOfARunAreRemoved) {
  touch_leftovers();
  const std::vector<std::string> kept = {"coefficients.csv", "maps/a.exr", "maps/deep/er/b.hdr",
                                         "mine/c.exr.shoal-tmp-1-1"};
  for (const auto& name : kept) touch(name);
  fs::create_directories(folder_ / "maps/folder.shoal-tmp-x");
  EXPECT_EQ(remove_leftovers(folder_.path()), 3);
  EXPECT_EQ(count_leftovers(), 0);
  for (const auto& name : kept) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  EXPECT_TRUE(fs::exists(folder_ / "maps/folder.shoal-tmp-x"));
  EXPECT_EQ(remove_leftovers(folder_ / "not there"), 0);
}

TEST_F(LeftoversTest, AfterAKilledRunTheyAreRemoved) {
  leave_mark();
  touch_leftovers();
  Store store = open_store();
  ASSERT_TRUE(RunMark::set(folder_.path(), store));
  EXPECT_EQ(count_leftovers(), 0);
}

TEST_F(LeftoversTest, AfterARunThatEndedNobodyLooks) {
  {
    Store store = open_store();
    auto mark = RunMark::set(folder_.path(), store);
    ASSERT_TRUE(mark);
    ASSERT_TRUE(mark->clear(store));
  }
  touch_leftovers();
  Store store = open_store();
  ASSERT_TRUE(RunMark::set(folder_.path(), store));
  EXPECT_EQ(count_leftovers(), 3);
}

// The temporary files of a run that goes on are its own.
TEST_F(LeftoversTest, WhileAnotherRunIsAtWorkNothingIsRemoved) {
  Store store = open_store();
  std::optional<Result<RunMark>> first(RunMark::set(folder_.path(), store));
  ASSERT_TRUE(*first);
  touch_leftovers();
  ASSERT_TRUE(RunMark::set(folder_.path(), store));
  EXPECT_EQ(count_leftovers(), 3);
  first.reset();
  ASSERT_TRUE(RunMark::set(folder_.path(), store));
  EXPECT_EQ(count_leftovers(), 0);
}

}  // namespace
}  // namespace shoal
