// Files that are cut off, damaged, or made to harm: an error or a picture, in little time and
// memory, and never a crash.
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfPartType.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>

#include "image/exr_file.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"

namespace shoal::test {
namespace {

using testing::HasSubstr;

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);  // or some file systems write to the disk at once
  std::ofstream(path, std::ios::binary) << bytes;
}

// Opens and reads every band, going on after errors: a reader must stay usable. Returns the first
// error's text, empty when there was none.
std::string read_everything(const std::filesystem::path& path) {
  const auto source = open_exr(path, {}, portable_chunk_codecs());
  if (!source) return source.error().text();
  auto reader = (*source)->new_reader();
  if (!reader) return reader.error().text();
  std::string first;
  for (int index = 0; index < (*source)->info().band_count; ++index) {
    const auto band = (*reader)->read(index);
    if (band || !first.empty()) continue;
    first = band.error().text();
    EXPECT_EQ(band.error().where.rfind(path.string() + ":", 0), 0u) << "no row in " << first;
  }
  return first;
}

// A file a kind, small enough to damage it in many ways.
std::vector<std::string> small_files(const TemporaryFolder& folder) {
  std::vector<std::string> files;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    for (const int tile : {0, 16}) {
      ExrRecipe recipe;
      recipe.data = recipe.display = {{0, 0}, {8, 34}};
      recipe.compression = static_cast<Imf::Compression>(compression);
      recipe.tile_width = recipe.tile_height = tile;
      recipe.channels.push_back("A");
      recipe.types.push_back(SampleType::float32);
      write_exr(folder / "made.exr", recipe);
      files.push_back(read_bytes(folder / "made.exr"));
    }
  }
  return files;
}

TEST(ExrHostile, EveryTruncationIsAnError) {
  const TemporaryFolder folder;
  const auto path = folder / "cut.exr";
  for (const std::string& file : small_files(folder)) {
    for (std::size_t size = 0; size < file.size(); size += 50) {
      write_bytes(path, file.substr(0, size));
      EXPECT_NE(read_everything(path), "") << size << " of " << file.size();
    }
    write_bytes(path, file.substr(0, file.size() - 1));
    EXPECT_NE(read_everything(path), "");
  }
}

TEST(ExrHostile, FlippedBitsDoNotCrash) {
  const TemporaryFolder folder;
  const auto path = folder / "flipped.exr";
  RandomNumbers random(17);
  for (const std::string& file : small_files(folder)) {
    for (int round = 0; round < 60; ++round) {
      std::string damaged = file;
      // Half of the rounds in the header, where a byte does most.
      const int span = round % 2 == 0 ? 400 : static_cast<int>(file.size());
      for (int flips = 1 + random.below(4); flips > 0; --flips) {
        damaged[random.below(span)] ^= static_cast<char>(1 << random.below(8));
      }
      write_bytes(path, damaged);
      read_everything(path);
    }
  }
}

// Replaces the value of the attribute `name` in a header.
template <typename T>
void set_attribute(std::string& file, const std::string& name, const T& value) {
  const std::size_t at = file.find(name + '\0');
  ASSERT_NE(at, std::string::npos);
  const std::size_t type = at + name.size() + 1;
  const std::size_t begin = file.find('\0', type) + 1 + sizeof(std::int32_t);
  std::memcpy(&file[begin], &value, sizeof value);
}

class ExrHostileHeader : public testing::Test {
 protected:
  void SetUp() override {
    write_exr(path_, {});
    file_ = read_bytes(path_);
  }
  std::string error() {
    write_bytes(path_, file_);
    return read_everything(path_);
  }
  void set_windows(std::array<std::int32_t, 4> box) {
    set_attribute(file_, "dataWindow", box);
    set_attribute(file_, "displayWindow", box);
  }
  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "hostile.exr";
  std::string file_;
};

TEST_F(ExrHostileHeader, SizesBeyondOurLimits) {
  set_windows({0, 0, 1 << 20, 3});
  EXPECT_THAT(error(), HasSubstr("1048577 x 4 pixels, more than can be read"));
  set_windows({-1000000000, -1000000000, 1000000000, 1000000000});
  EXPECT_NE(error(), "");
  set_windows({0, 0, (1 << 18) - 1, (1 << 18) - 1});
  EXPECT_NE(error(), "");
  set_windows({0, 0, -1, -1});
  EXPECT_NE(error(), "");
  set_windows({INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX});
  EXPECT_NE(error(), "");
}

TEST_F(ExrHostileHeader, PictureThatCannotBeInTheFile) {
  set_windows({0, 0, 65535, 32});  // as many chunks as before, 2000 times as wide
  EXPECT_THAT(error(), HasSubstr("follow its header"));
  set_windows({0, 0, 32, 99999});
  EXPECT_THAT(error(), HasSubstr("table of chunks"));
}

TEST_F(ExrHostileHeader, DisplayWindowMayBeLargeAndCostsNothing) {
  set_attribute(file_, "displayWindow", std::array<std::int32_t, 4>{0, 0, 99999, 99999});
  EXPECT_EQ(error(), "");
}

TEST_F(ExrHostileHeader, UnknownCompression) {
  set_attribute(file_, "compression", std::uint8_t{77});
  EXPECT_THAT(error(), HasSubstr("compressed by method 77"));
}

// What is missing would be made up by the library, and is not to be.
TEST_F(ExrHostileHeader, RequiredAttributesMustBeThere) {
  const std::string whole = file_;
  for (const std::string name : {"channels", "compression", "dataWindow", "displayWindow"}) {
    file_ = whole;
    file_[file_.find(name + '\0')] = 'X';
    EXPECT_NE(error(), "") << name;
  }
  file_ = whole;
  file_[file_.find("dataWindow")] = 'X';
  EXPECT_THAT(error(), HasSubstr("needs one attribute dataWindow"));
}

// The classes that read DWAA make room for a tile as it is declared, however small the picture is.
TEST_F(ExrHostileHeader, TilesAsLargeAsAnIntegerHolds) {
  for (const Imf::Compression compression : {Imf::ZIP_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    ExrRecipe recipe;
    recipe.compression = compression;
    recipe.tile_width = recipe.tile_height = 16;
    write_exr(path_, recipe);
    file_ = read_bytes(path_);
    for (const std::uint32_t size : {0u, 1u, 1u << 30, 0x7fffffffu, 0xffffffffu}) {
      set_attribute(file_, "tiles", std::array<std::uint32_t, 2>{size, size});
      EXPECT_NE(error(), "") << size;
    }
    set_attribute(file_, "tiles", std::array<std::uint32_t, 2>{1u << 14, 1u << 14});
    EXPECT_THAT(error(), HasSubstr("chunks of 1536 MiB"));
  }
}

TEST(ExrHostile, ChunkThatSaysItIsLonger) {
  const TemporaryFolder folder;
  const auto path = folder / "made.exr";
  write_exr(path, {});
  std::string file = read_bytes(path);
  // The last chunk: lines 16 to 20. Its leader stands before the rest of the file.
  const std::int32_t line = 16;
  const std::size_t leader = file.rfind(std::string(reinterpret_cast<const char*>(&line), 4));
  ASSERT_NE(leader, std::string::npos);
  for (const std::int32_t size : {-1, 0, 1, 100000, INT32_MAX, INT32_MIN}) {
    std::memcpy(&file[leader + 4], &size, sizeof size);
    write_bytes(path, file);
    EXPECT_THAT(read_everything(path), HasSubstr("made.exr:16: the pixels of rows 16 to 20"))
        << size;
  }
}

TEST(ExrHostile, MissingFileAndFolder) {
  const TemporaryFolder folder;
  const auto missing = open_exr(folder / "none.exr", {}, portable_chunk_codecs());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  const auto directory = open_exr(folder.path(), {}, portable_chunk_codecs());
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().code, ErrorCode::unreadable);
}

TEST(ExrHostile, DeepFilesAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "deep.exr";
  constexpr int kSide = 4;
  {
    Imf::Header header(kSide, kSide);
    for (const char* name : {"R", "G", "B"})
      header.channels().insert(name, Imf::Channel(Imf::HALF));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    std::vector<unsigned> counts(kSide * kSide, 1);
    std::vector<half> sample(1, half(0.5f));
    std::vector<half*> pointers(kSide * kSide, sample.data());
    Imf::DeepFrameBuffer slices;
    slices.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()),
                                             sizeof(unsigned), sizeof(unsigned) * kSide));
    for (const char* name : {"R", "G", "B"}) {
      slices.insert(name, Imf::DeepSlice(Imf::HALF, reinterpret_cast<char*>(pointers.data()),
                                         sizeof(half*), sizeof(half*) * kSide, sizeof(half)));
    }
    Imf::DeepScanLineOutputFile file(path.c_str(), header, 0);
    file.setFrameBuffer(slices);
    file.writePixels(kSide);
  }
  const auto source = open_exr(path, {}, portable_chunk_codecs());
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::unsupported);
  EXPECT_THAT(source.error().what, HasSubstr("deep data"));
}

// Finds of other readers' fuzzers: whatever they are, they are done with quickly, and silently.
TEST(ExrHostile, FindsOfFuzzersTakeNoTime) {
  for (const char* name : {"openexr-images/Damaged", "bad_inputs", "openexr-testsuite"}) {
    SHOAL_REQUIRE_TEST_DATA(name);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data_folder() / name)) {
      if (!entry.is_regular_file()) continue;
      testing::internal::CaptureStderr();
      const auto begin = std::chrono::steady_clock::now();
      read_everything(entry.path());
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << entry.path();
      EXPECT_LT(took.count(), 2.0) << entry.path();
    }
  }
}

}  // namespace
}  // namespace shoal::test
