#include "batch/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "batch/sqlite.h"
#include "batch/store_schema.h"
#include "batch/store_support.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::some_item;
using test::some_projection;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(StoreOpen, ReadingNeedsAStore) {
  const TemporaryFolder folder;
  const auto store = Store::open(folder / "shoal.db", Store::Access::read);
  ASSERT_FALSE(store.ok());
  EXPECT_EQ(store.error().code, ErrorCode::not_found);
  EXPECT_THAT(store.error().hint, HasSubstr("shoal run"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// A run that is killed at its very beginning leaves an empty file.
TEST(StoreOpen, AnEmptyFileIsAStoreThatIsNotThereYet) {
  const TemporaryFolder folder;
  std::ofstream(folder / "s.db").close();
  const auto missing = Store::open(folder / "s.db", Store::Access::read);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  EXPECT_TRUE(Store::open(folder / "s.db", Store::Access::write).ok());
  EXPECT_TRUE(Store::open(folder / "s.db", Store::Access::read).ok());
}

TEST(StoreOpen, ReadingChangesNothing) {
  const TemporaryFolder folder;
  { auto store = Store::open(folder / "s.db", Store::Access::write); }
  auto store = Store::open(folder / "s.db", Store::Access::read);
  ASSERT_TRUE(store.ok());
  EXPECT_FALSE(store->set_property("a", "b").ok());
}

TEST(StoreOpen, LeavesNoFileBesideIt) {
  const TemporaryFolder folder;
  {
    auto store = Store::open(folder / "s.db", Store::Access::write);
    ASSERT_TRUE(store->set_property("a", "b").ok());
  }
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_EQ(names, std::vector<std::string>{"s.db"});
}

TEST(StoreOpen, RefusesANewerVersion) {
  const TemporaryFolder folder;
  const auto path = folder / "s.db";
  { auto store = Store::open(path, Store::Access::write); }
  auto database = SqlDatabase::open(path, SqlDatabase::Create::never);
  ASSERT_TRUE(database->execute("PRAGMA user_version = 1000").ok());
  for (const auto access : {Store::Access::write, Store::Access::read}) {
    const auto store = Store::open(path, access);
    ASSERT_FALSE(store.ok());
    EXPECT_EQ(store.error().code, ErrorCode::unsupported);
    EXPECT_EQ(store.error().where, path.string());
    EXPECT_THAT(store.error().what, AllOf(HasSubstr("version 1000"),
                      HasSubstr("knows version " + std::to_string(kStoreVersion))));
    EXPECT_THAT(store.error().hint, HasSubstr("another output folder"));
  }
}

TEST(StoreOpen, RefusesTheDatabaseOfAnotherProgramAndLeavesItAlone) {
  const TemporaryFolder folder;
  const auto path = folder / "s.db";
  {
    auto database = SqlDatabase::open(path, SqlDatabase::Create::when_missing);
    ASSERT_TRUE(database->execute("CREATE TABLE mine (x); INSERT INTO mine VALUES (5)").ok());
  }
  const auto store = Store::open(path, Store::Access::write);
  ASSERT_FALSE(store.ok());
  EXPECT_EQ(store.error().code, ErrorCode::malformed);
  EXPECT_THAT(store.error().what, HasSubstr("not a store of shoal"));
  auto database = SqlDatabase::open(path, SqlDatabase::Create::never);
  EXPECT_EQ(*database->integer_of("SELECT x FROM mine"), 5);
}

TEST(StoreOpen, ADamagedFileIsAnErrorThatSaysWhatToDo) {
  const TemporaryFolder folder;
  const auto path = folder / "s.db";
  std::ofstream(path) << std::string(10000, 'x');
  for (const auto access : {Store::Access::write, Store::Access::read}) {
    const auto store = Store::open(path, access);
    ASSERT_FALSE(store.ok());
    EXPECT_EQ(store.error().code, ErrorCode::malformed);
    EXPECT_EQ(store.error().where, path.string());
    EXPECT_THAT(store.error().what, HasSubstr("damaged"));
    EXPECT_THAT(store.error().hint, HasSubstr("delete it and run again"));
  }
}

// Wherever a store is cut or overwritten, using it gives results or errors, never a crash; and a
// cut store never passes for whole.
TEST(StoreOpen, ADamagedPageIsFoundWhenItIsRead) {
  const TemporaryFolder folder;
  const auto path = folder / "s.db";
  {
    auto store = Store::open(path, Store::Access::write);
    const Projection projection = some_projection(1, 8);
    for (int i = 0; i < 200; ++i) {
      ASSERT_TRUE(store->record(some_item("item " + std::to_string(i), &projection)).ok());
    }
  }
  const auto size = std::filesystem::file_size(path);
  const auto use = [](const std::filesystem::path& damaged) -> Status {
    SHOAL_ASSIGN_OR_RETURN(store, Store::open(damaged, Store::Access::write));
    SHOAL_RETURN_IF_ERROR(store.items());
    SHOAL_RETURN_IF_ERROR(store.find_projection("item 150"));
    const Projection projection = some_projection(2, 8);
    SHOAL_RETURN_IF_ERROR(store.record(some_item("item 3", &projection)));
    return store.flush();
  };
  for (int part = 1; part < 16; ++part) {
    const auto cut = folder / "cut.db";
    std::filesystem::copy_file(path, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, size * part / 16);
    const Status status = use(cut);
    ASSERT_FALSE(status.ok()) << part;
    EXPECT_EQ(status.error().code, ErrorCode::malformed) << status.error().text();
  }
  int errors = 0;
  for (std::uint64_t offset = 0; offset < size; offset += 4096) {
    const auto scratched = folder / "scratched.db";
    std::filesystem::copy_file(path, scratched, std::filesystem::copy_options::overwrite_existing);
    std::fstream stream(scratched, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(offset));
    stream << std::string(200, '\xa5');
    stream.close();
    if (const Status status = use(scratched); !status) {
      ++errors;
      EXPECT_EQ(status.error().code, ErrorCode::malformed) << status.error().text();
    }
  }
  EXPECT_GT(errors, 10);
}

}  // namespace
}  // namespace shoal
