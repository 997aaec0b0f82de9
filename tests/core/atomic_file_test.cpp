#include "core/atomic_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <string>
#include <utility>

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

TEST(AtomicFile, SaysWhichFileCannotBeWrittenWhyAndWhatToDo) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "file", "x"));
  ASSERT_TRUE(std::filesystem::create_directory(folder / "folder"));
  const std::string file = (folder / "file").string();
  const std::string taken = (folder / "folder").string();
  const std::pair<std::string, std::string> refusals[] = {
      {file + "/below", file + ": cannot be made: Not a directory (a part of the path is a file; "
                               "name another folder)"},
      {taken, taken + ": cannot be renamed into place: Is a directory (there is a folder of that "
                      "name; name another file)"},
      {"/proc/file",
       "/proc/file: cannot be opened for writing: No such file or directory (its "
       "folder takes no new files; name another one)"}};
  for (const auto& [path, text] : refusals) {
    const Status written = write_file_atomically(path, "x");
    ASSERT_FALSE(written) << path;
    EXPECT_EQ(written.error().code, ErrorCode::write_failed);
    EXPECT_EQ(written.error().text(), text);
  }
}

}  // namespace
}  // namespace shoal
