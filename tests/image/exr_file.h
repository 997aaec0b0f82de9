// EXR files that a test makes itself with OpenEXR's C++ classes, and what those classes read back:
// the independent decoder. Samples are compared as bytes, in the file's own sample type.
#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "image/exr_source.h"
#include "support/random_numbers.h"

namespace shoal::test {

// Planes of samples as bytes, each height x width, tightly packed.
struct RawPicture {
  int width = 0;
  int height = 0;
  std::vector<SampleType> types;
  std::vector<std::vector<std::byte>> planes;

  RawPicture() = default;
  RawPicture(int width_in, int height_in, std::vector<SampleType> types_in)
      : width(width_in), height(height_in), types(std::move(types_in)) {
    for (const SampleType type : types) {
      planes.emplace_back(static_cast<std::size_t>(width) * height * sample_size(type));
    }
  }
  [[nodiscard]] std::byte* at(int plane, int row, int column) {
    return planes[plane].data() +
           (static_cast<std::size_t>(row) * width + column) * sample_size(types[plane]);
  }
  bool operator==(const RawPicture&) const = default;
};

// What a file is made of. Windows are inclusive boxes, as OpenEXR's.
struct ExrRecipe {
  Imath::Box2i data{{0, 0}, {32, 20}};
  Imath::Box2i display{{0, 0}, {32, 20}};
  std::vector<std::string> channels = {"R", "G", "B"};
  std::vector<SampleType> types = {SampleType::half, SampleType::half, SampleType::half};
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder line_order = Imf::INCREASING_Y;
  int tile_width = 0;  // 0: scanlines
  int tile_height = 0;
  Imf::LevelMode levels = Imf::ONE_LEVEL;
};

inline Imf::PixelType pixel_type(SampleType type) {
  if (type == SampleType::half) return Imf::HALF;
  return type == SampleType::float32 ? Imf::FLOAT : Imf::UINT;
}

inline SampleType sample_type(Imf::PixelType type) {
  if (type == Imf::HALF) return SampleType::half;
  return type == Imf::FLOAT ? SampleType::float32 : SampleType::uint32;
}

inline int width_of(const Imath::Box2i& box) { return box.max.x - box.min.x + 1; }
inline int height_of(const Imath::Box2i& box) { return box.max.y - box.min.y + 1; }

inline void store_sample(SampleType type, double value, std::byte* at) {
  if (type == SampleType::half) {
    const half sample(static_cast<float>(value));
    std::memcpy(at, &sample, sizeof sample);
  } else if (type == SampleType::float32) {
    const auto sample = static_cast<float>(value);
    std::memcpy(at, &sample, sizeof sample);
  } else {
    const auto sample = static_cast<std::uint32_t>(value * 1000.0);
    std::memcpy(at, &sample, sizeof sample);
  }
}

// A slope with noise and flat stretches: what compresses, what does not, and what repeats.
inline RawPicture make_raw(int width, int height, const std::vector<SampleType>& types,
                           std::uint64_t seed) {
  RandomNumbers random(seed);
  RawPicture picture(width, height, types);
  for (int c = 0; c < static_cast<int>(types.size()); ++c) {
    for (int row = 0; row < height; ++row) {
      const bool is_flat = row % 5 == 3;
      for (int column = 0; column < width; ++column) {
        const double noise = column % 7 < 3 ? 0.0 : random.between(0.0, 2.0);
        const double value = is_flat ? 1.5 : 0.1 * column + 0.3 * row + noise;
        store_sample(types[c], value, picture.at(c, row, column));
      }
    }
  }
  return picture;
}

inline Imf::Header make_header(const ExrRecipe& recipe) {
  Imf::Header header(recipe.display, recipe.data, 1, {0, 0}, 1, recipe.line_order,
                     recipe.compression);
  for (std::size_t i = 0; i < recipe.channels.size(); ++i) {
    header.channels().insert(recipe.channels[i], Imf::Channel(pixel_type(recipe.types[i])));
  }
  if (recipe.tile_width > 0) {
    header.setTileDescription({static_cast<unsigned>(recipe.tile_width),
                               static_cast<unsigned>(recipe.tile_height), recipe.levels});
  }
  return header;
}

// Slices over `pixels`, whose first sample is pixel (x, y) of the plane of the windows.
inline Imf::FrameBuffer slices_of(RawPicture& pixels, const std::vector<std::string>& channels,
                                  int x, int y) {
  Imf::FrameBuffer slices;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto size = static_cast<std::ptrdiff_t>(sample_size(pixels.types[i]));
    const std::ptrdiff_t stride = size * pixels.width;
    const auto base =
        reinterpret_cast<std::intptr_t>(pixels.planes[i].data()) - x * size - y * stride;
    slices.insert(channels[i], Imf::Slice(pixel_type(pixels.types[i]),
                                          reinterpret_cast<char*>(base), size, stride));
  }
  return slices;
}

// Writes `pixels` (the data window). Levels beyond 0 get the picture's upper left corner: they must
// not be read, and hold something else than level 0.
inline void write_exr(const std::filesystem::path& path, const ExrRecipe& recipe, RawPicture pixels,
                      const Imf::Header* with_header = nullptr) {
  // Some file systems write a file that is overwritten to the disk at once, which takes time.
  std::filesystem::remove(path);
  const Imf::Header header = with_header ? *with_header : make_header(recipe);
  const int x = recipe.data.min.x;
  const int y = recipe.data.min.y;
  const Imf::FrameBuffer slices = slices_of(pixels, recipe.channels, x, y);
  if (recipe.tile_width == 0) {
    Imf::OutputFile file(path.c_str(), header, 0);
    file.setFrameBuffer(slices);
    file.writePixels(height_of(recipe.data));
    return;
  }
  Imf::TiledOutputFile file(path.c_str(), header, 0);
  file.setFrameBuffer(slices);
  for (int ly = 0; ly < file.numYLevels(); ++ly) {
    for (int lx = 0; lx < file.numXLevels(); ++lx) {
      if (recipe.levels != Imf::RIPMAP_LEVELS && lx != ly) continue;
      file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
    }
  }
}

inline void write_exr(const std::filesystem::path& path, const ExrRecipe& recipe) {
  write_exr(path, recipe, make_raw(width_of(recipe.data), height_of(recipe.data), recipe.types, 1));
}

enum class PictureWindow { display, data };

// The picture, one of the windows, as OpenEXR decodes it; black outside of the data window.
inline RawPicture read_with_imf(const std::filesystem::path& path,
                                const std::vector<std::string>& channels, int part_number = 0,
                                PictureWindow which = PictureWindow::display) {
  Imf::MultiPartInputFile file(path.c_str(), 0);
  Imf::InputPart part(file, part_number);
  const Imath::Box2i data = part.header().dataWindow();
  const Imath::Box2i window = which == PictureWindow::data ? data : part.header().displayWindow();
  std::vector<SampleType> types;
  for (const std::string& name : channels) {
    types.push_back(sample_type(part.header().channels()[name].type));
  }
  RawPicture decoded(width_of(data), height_of(data), types);
  part.setFrameBuffer(slices_of(decoded, channels, data.min.x, data.min.y));
  part.readPixels(data.min.y, data.max.y);

  RawPicture picture(width_of(window), height_of(window), types);
  for (int c = 0; c < static_cast<int>(types.size()); ++c) {
    for (int y = std::max(window.min.y, data.min.y); y <= std::min(window.max.y, data.max.y); ++y) {
      const int from = std::max(window.min.x, data.min.x);
      const int to = std::min(window.max.x, data.max.x);
      if (to < from) continue;
      std::memcpy(picture.at(c, y - window.min.y, from - window.min.x),
                  decoded.at(c, y - data.min.y, from - data.min.x),
                  static_cast<std::size_t>(to - from + 1) * sample_size(types[c]));
    }
  }
  return picture;
}

// Copies a band's rows to where they belong; fails the test if they do not belong there.
inline void store_band(const RowBand& band, RawPicture& picture) {
  ASSERT_EQ(band.width, picture.width);
  ASSERT_LT(band.row_begin, band.row_end);
  ASSERT_GE(band.row_begin, 0);
  ASSERT_LE(band.row_end, picture.height);
  for (int c = 0; c < band.channel_count; ++c) {
    ASSERT_EQ(band.channels[c].type, picture.types[c]);
    for (int row = 0; row < band.row_count(); ++row) {
      std::memcpy(picture.at(c, band.row_begin + row, 0), band.channels[c].row(row),
                  static_cast<std::size_t>(band.width) * sample_size(band.channels[c].type));
    }
  }
}

// Reads all bands in order; they must follow each other from the first row to the last.
inline Result<RawPicture> read_raw(const PanoramaSource& source) {
  const PictureInfo& info = source.info();
  SHOAL_ASSIGN_OR_RETURN(reader, source.new_reader());
  RawPicture picture;
  int next_row = 0;
  for (int index = 0; index < info.band_count; ++index) {
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(index));
    if (index == 0) {
      std::vector<SampleType> types;
      for (int c = 0; c < band.channel_count; ++c) types.push_back(band.channels[c].type);
      picture = RawPicture(info.width, info.height, types);
    }
    EXPECT_EQ(band.channel_count, info.channel_count);
    EXPECT_EQ(band.row_begin, next_row);
    EXPECT_LE(band.row_count(), info.rows_per_band);
    next_row = band.row_end;
    store_band(band, picture);
  }
  EXPECT_EQ(next_row, info.height);
  return picture;
}

inline Result<RawPicture> read_raw(const std::filesystem::path& path,
                                   const ReadOptions& options = {}) {
  SHOAL_ASSIGN_OR_RETURN(source, open_exr(path, options, portable_chunk_codecs()));
  return read_raw(*source);
}

}  // namespace shoal::test
