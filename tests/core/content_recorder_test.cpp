#include "core/content_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <vector>

#include "core/input_file.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

constexpr std::size_t kSize = 300'000;

struct Read {
  std::uint64_t offset;
  std::size_t size;
};

// Whatever is read of the file, in whatever order, the digest is the file's hash.
class ContentRecorderTest : public ::testing::Test {
 protected:
  ContentRecorderTest() {
    std::string text;
    for (std::size_t i = 0; text.size() < kSize; ++i) text += std::to_string(i * i) + ' ';
    text.resize(kSize);
    std::ofstream(path_, std::ios::binary) << text;
  }

  void read_all(const std::vector<Read>& reads, const std::shared_ptr<ContentRecorder>& recorder) {
    const auto file = InputFile::open(path_, recorder);
    ASSERT_TRUE(file) << file.error().text();
    for (const Read& read : reads) {
      std::vector<std::byte> bytes(read.size);
      ASSERT_TRUE(file->read_some(read.offset, bytes));
    }
  }

  void expect_hash_after(const std::vector<Read>& reads) {
    const auto recorder = std::make_shared<ContentRecorder>();
    read_all(reads, recorder);
    const auto digest = recorder->digest(path_);
    ASSERT_TRUE(digest) << digest.error().text();
    EXPECT_EQ(*digest, *hash_file(path_));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "file";
};

TEST_F(ContentRecorderTest, TakesReadsInOrder) {
  expect_hash_after({});
  expect_hash_after({{0, kSize}});
  expect_hash_after({{0, 1}, {1, 100'000}, {100'001, kSize}});
  expect_hash_after({{0, 1000}, {0, 500}, {200, 2000}, {2200, 10}});  // some of it again
}

TEST_F(ContentRecorderTest, ReadsForItselfWhatCameOutOfOrder) {
  expect_hash_after({{kSize - 100, 100}});
  expect_hash_after({{kSize - 100, 100}, {0, 1000}, {2000, 1000}, {1000, 1000}});
  expect_hash_after({{kSize, 10}, {kSize + 10, 10}});  // behind the end
}

TEST_F(ContentRecorderTest, ManyThreadsMayRead) {
  const auto recorder = std::make_shared<ContentRecorder>();
  {
    std::vector<std::jthread> threads;
    for (std::size_t first = 0; first < 4; ++first) {
      threads.emplace_back([&, first] {
        std::vector<Read> reads;
        for (std::size_t at = first * 1000; at < kSize; at += 4000) reads.push_back({at, 1000});
        read_all(reads, recorder);
      });
    }
  }
  EXPECT_EQ(*recorder->digest(path_), *hash_file(path_));
}

// So that it is known to spare the second reading: what was seen is not read again, even if it is
// another now. (Whoever hashes a file that changes compares its modification time.)
TEST_F(ContentRecorderTest, DoesNotReadAgainWhatItSaw) {
  const std::string before = *hash_file(path_);
  const auto recorder = std::make_shared<ContentRecorder>();
  read_all({{0, kSize}}, recorder);
  std::fstream(path_, std::ios::in | std::ios::out | std::ios::binary) << "changed";
  EXPECT_EQ(*recorder->digest(path_), before);
  EXPECT_NE(*hash_file(path_), before);
}

TEST_F(ContentRecorderTest, AFileThatIsGoneIsAnError) {
  ContentRecorder recorder;
  EXPECT_EQ(recorder.digest(folder_ / "none").error().code, ErrorCode::not_found);
}

// It is a hint: nothing it is asked for may do any harm.
TEST_F(ContentRecorderTest, PrefetchingChangesNothing) {
  const std::string before = *hash_file(path_);
  prefetch_file(path_, kSize);
  prefetch_file(path_, ~std::uint64_t{0});
  prefetch_file(folder_ / "none", 1);
  prefetch_file(folder_ / ".", 1);
  EXPECT_EQ(*hash_file(path_), before);
}

}  // namespace
}  // namespace shoal
