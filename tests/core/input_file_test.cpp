#include "core/input_file.h"

#include <gtest/gtest.h>

#include <array>

#include "core/atomic_file.h"
#include "core/content_hash.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

TEST(InputFile, ReadsAtAnyOffset) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "digits", "0123456789"));
  auto file = InputFile::open(folder / "digits");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_EQ(file->size(), 10U);
  std::array<std::byte, 4> bytes;
  ASSERT_TRUE(file->read_exactly(3, bytes));
  EXPECT_EQ(bytes[0], std::byte{'3'});
  EXPECT_EQ(bytes[3], std::byte{'6'});
  EXPECT_EQ(file->read_some(8, bytes).value(), 2U);
  EXPECT_EQ(file->read_some(99, bytes).value(), 0U);
}

TEST(InputFile, SaysWhereAFileIsCutOff) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "short", "0123456789"));
  auto file = InputFile::open(folder / "short");
  ASSERT_TRUE(file);
  std::array<std::byte, 8> bytes;
  const Status cut = file->read_exactly(6, bytes);
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::malformed);
  EXPECT_EQ(cut.error().what, "ends at byte 10, where 4 more were expected");
}

TEST(InputFile, TellsWhatCannotBeOpened) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(InputFile::open(folder / "nothing").error().code, ErrorCode::not_found);
  EXPECT_EQ(InputFile::open(folder.path()).error().code, ErrorCode::unreadable);
}

// The empty input's XXH3-128 is a published test value of xxHash; and content alone decides.
TEST(ContentHash, IsXxh3OfTheBytes) {
  EXPECT_EQ(hash_text(""), "99aa06d3014798d86001c324468d497f");
  ContentHasher pieces;
  pieces.update("0123");
  pieces.update("456789");
  EXPECT_EQ(pieces.digest(), hash_text("0123456789"));
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "digits", "0123456789"));
  EXPECT_EQ(hash_file(folder / "digits").value(), hash_text("0123456789"));
  EXPECT_NE(hash_text("0123456789"), hash_text("0123456788"));
}

}  // namespace
}  // namespace shoal
