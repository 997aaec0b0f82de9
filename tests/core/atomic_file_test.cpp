#include "core/atomic_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "support/temporary_folder.h"

namespace shoal {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

int file_count(const std::filesystem::path& folder) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    static_cast<void>(entry);
    ++count;
  }
  return count;
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const test::TemporaryFolder folder;
  const auto path = folder / "deep/er/table.csv";
  auto file = AtomicFile::create(path);
  ASSERT_TRUE(file) << file.error().text();
  ASSERT_TRUE(file->write("abcdef"));
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_THAT(file->temporary_path().string(), testing::HasSubstr(kTemporaryMark));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content_of(path), "abcdef");
  EXPECT_EQ(file_count(path.parent_path()), 1);
}

TEST(AtomicFile, LeavesNothingBehindAndTheOldFileAloneWhenGivenUp) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "table.csv", "old"));
  {
    auto file = AtomicFile::create(folder / "table.csv");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write("new"));
  }
  EXPECT_EQ(content_of(folder / "table.csv"), "old");
  EXPECT_EQ(file_count(folder.path()), 1);
}

TEST(AtomicFile, OverwritesInPlace) {
  const test::TemporaryFolder folder;
  auto file = AtomicFile::create(folder / "x");
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write("0123456789"));
  ASSERT_TRUE(file->write_at(2, std::as_bytes(std::span("ab", 2))));
  ASSERT_TRUE(file->write("!"));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content_of(folder / "x"), "01ab456789!");
}

TEST(AtomicFile, SaysWhichFileCannotBeWrittenAndWhy) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "file", "x"));
  const auto file = AtomicFile::create(folder / "file" / "below");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::write_failed);
  EXPECT_EQ(file.error().text(), (folder / "file").string() + ": cannot be made: Not a directory");
}

}  // namespace
}  // namespace shoal
