// What ExrInflater makes of chunks, in PXR24 above all; the other compressions have tests of their
// own, and exr_made_test.cpp compares all of them with OpenEXR.
#include "image/exr_inflate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/exr_file.h"
#include "image/exr_pxr24.h"
#include "image/zlib_streams.h"
#include "support/temporary_folder.h"

namespace shoal::test {
namespace {

// Any bit pattern may be a sample: NaNs, infinities, denormals, integers of 32 bits. The writer
// rounds floats; what it made of them, both decoders must find.
TEST(ExrPxr24, EveryBitPatternIsReadAsByOpenExr) {
  const TemporaryFolder folder;
  const auto path = folder / "made.exr";
  RandomNumbers random(1);
  for (const auto& types : std::vector<std::vector<SampleType>>{
           {SampleType::half, SampleType::half, SampleType::half},
           {SampleType::float32, SampleType::float32, SampleType::float32},
           {SampleType::uint32, SampleType::uint32, SampleType::uint32},
           {SampleType::half, SampleType::float32, SampleType::uint32}}) {
    for (const int tile : {0, 24}) {
      RawPicture pixels(67, 131, types);
      for (auto& plane : pixels.planes) {
        // Long runs of equal bytes among the noise, or chunks would be stored as they are.
        std::byte value{};
        for (std::byte& byte : plane) {
          if (random.below(6) == 0) value = static_cast<std::byte>(random.bits());
          byte = value;
        }
      }
      ExrRecipe recipe;
      recipe.data = recipe.display = {{0, 0}, {pixels.width - 1, pixels.height - 1}};
      recipe.types = types;
      recipe.compression = Imf::PXR24_COMPRESSION;
      recipe.tile_width = recipe.tile_height = tile;
      write_exr(path, recipe, pixels);
      const auto picture = read_raw(path);
      ASSERT_TRUE(picture) << picture.error().text();
      EXPECT_TRUE(*picture == read_with_imf(path, {"R", "G", "B"})) << tile;
    }
  }
}

constexpr std::size_t kWidth = 100;
constexpr std::size_t kRows = 3;
const std::array kTypes = {SampleType::half, SampleType::float32, SampleType::uint32};
const ExrChunkShape kShape{kTypes, kWidth, kRows};
constexpr std::size_t kLineBytes = kWidth * (2 + 4 + 4);

// A line's first difference alone is not zero, so all its samples are equal to it: byte b of plane
// p of the channel. The float's lowest byte is not stored.
TEST(ExrPxr24, EqualSamplesComeFromOneDifference) {
  Bytes planes;
  for (std::size_t row = 0; row < kRows; ++row) {
    for (int plane = 1; plane <= 2 + 3 + 4; ++plane) {
      planes.push_back(static_cast<std::byte>(16 * row + plane));
      planes.resize(planes.size() + kWidth - 1);
    }
  }
  ASSERT_EQ(pxr24_planes_size(kShape), planes.size());
  const Bytes packed = compress_with_libdeflate(planes, 6);
  Bytes lines(kRows * kLineBytes);
  ExrInflater inflater(EXR_COMPRESSION_PXR24, portable_chunk_codecs());
  const ExrInflater::Chunk chunk{packed, kShape, lines};
  ASSERT_EQ(inflater.expand({&chunk, 1}), 1u);
  const std::byte* at = lines.data();
  for (std::size_t row = 0; row < kRows; ++row) {
    const auto plane = [&](int p) { return static_cast<std::byte>(16 * row + p); };
    const std::vector<std::vector<std::byte>> samples = {
        {plane(2), plane(1)},
        {std::byte{0}, plane(5), plane(4), plane(3)},
        {plane(9), plane(8), plane(7), plane(6)}};
    for (const auto& sample : samples) {
      for (std::size_t i = 0; i < kWidth; ++i, at += sample.size()) {
        ASSERT_TRUE(std::equal(sample.begin(), sample.end(), at)) << row << " " << i;
      }
    }
  }
}

TEST(ExrPxr24, PlanesOfAnotherSizeAreDamaged) {
  ExrInflater inflater(EXR_COMPRESSION_PXR24, portable_chunk_codecs());
  const std::size_t right = pxr24_planes_size(kShape);
  Bytes lines(kRows * kLineBytes);
  for (const std::size_t size : {std::size_t{0}, right - 1, right, right + 1, lines.size()}) {
    const Bytes packed = compress_with_libdeflate(Bytes(size), 6);
    const ExrInflater::Chunk chunk{packed, kShape, lines};
    EXPECT_EQ(inflater.expand({&chunk, 1}), size == right ? 1u : 0u) << size;
  }
}

// EXR's run lengths of so many zeros: of 128 each, and a rest.
Bytes runs_of_zeros(std::size_t size) {
  Bytes runs;
  for (; size > 0; size -= std::min<std::size_t>(size, 128)) {
    runs.push_back(static_cast<std::byte>(std::min<std::size_t>(size, 128) - 1));
    runs.push_back(std::byte{0});
  }
  return runs;
}

// Chunks that are stored as they are come between others; the first damaged one is named, although
// several are expanded at a time.
TEST(ExrInflater, NamesTheFirstDamagedChunk) {
  constexpr std::size_t kChunks = 11;
  const std::vector<SampleType> types = {SampleType::half};
  RandomNumbers random(2);
  for (const exr_compression_t compression : {EXR_COMPRESSION_ZIP, EXR_COMPRESSION_RLE}) {
    ExrInflater inflater(compression, portable_chunk_codecs());
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<Bytes> packed(kChunks);
      std::vector<Bytes> out(kChunks);
      std::vector<ExrInflater::Chunk> chunks;
      std::size_t first_damaged = kChunks;
      for (std::size_t i = 0; i < kChunks; ++i) {
        const std::size_t width = 64 + random.below(1000);
        out[i].resize(2 * width);
        const int kind = random.below(10);
        packed[i] = compression == EXR_COMPRESSION_RLE
                        ? runs_of_zeros(out[i].size())
                        : compress_with_libdeflate(Bytes(out[i].size()), 6);
        if (kind == 0) packed[i] = Bytes(out[i].size(), std::byte{1});
        if (kind == 1) packed[i].resize(packed[i].size() - 1);
        if (kind == 1) first_damaged = std::min(first_damaged, i);
        chunks.push_back({packed[i], {types, width, 1}, out[i]});
      }
      EXPECT_EQ(inflater.expand(chunks), first_damaged);
    }
  }
}

}  // namespace
}  // namespace shoal::test
