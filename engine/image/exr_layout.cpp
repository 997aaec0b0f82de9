#include "image/exr_layout.h"

#include <algorithm>
#include <optional>

#include "image/panorama_source.h"
#include "image/zlib_inflater.h"

namespace shoal {
namespace {

// A chunk is decoded whole. 256 MiB is a chunk of DWAB (256 lines) 32768 pixels wide with 8
// channels.
constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{1} << 28;
constexpr std::uint64_t kMaxBandBytes = std::uint64_t{1} << 26;  // of several chunks
// Bands of files that store every line by itself: long enough that a read and a dispatch cost
// little beside the decoding, short enough for a second-level cache.
constexpr int kDefaultRowsOfLineChunks = 32;
// Bands of files of larger zlib streams: several, because they are inflated faster together, but no
// more bytes than this, of which every thread needs about two and a half times as many.
constexpr std::uint64_t kBytesOfZlibChunks = 4 << 20;

template <typename T>
constexpr T divide_up(T value, T by) {
  return (value + by - 1) / by;
}

// The largest factor by which a compression can blow a chunk up, if there is one.
std::optional<std::uint64_t> largest_expansion(exr_compression_t compression) {
  constexpr std::uint64_t kDeflate = 1032;  // zlib's documented bound
  constexpr std::uint64_t kRunLength = 64;  // two bytes stand for at most 128
  switch (compression) {
    case EXR_COMPRESSION_NONE:
      return 1;
    case EXR_COMPRESSION_RLE:
      return kRunLength;
    case EXR_COMPRESSION_ZIPS:
    case EXR_COMPRESSION_ZIP:
      return kDeflate;
    case EXR_COMPRESSION_PXR24:
      return kDeflate * 4 / 3;  // a float is stored in three bytes
    // 256 equal 16-bit values become two codes of one bit at least and a count of eight: 410.
    case EXR_COMPRESSION_PIZ:
      return 512;
    // A flat block of 16 halves (32 bytes) takes 3 bytes (B44A), any other 14.
    case EXR_COMPRESSION_B44:
    case EXR_COMPRESSION_B44A:
      return 11;
    // Runs within deflate is the most of its schemes.
    case EXR_COMPRESSION_DWAA:
    case EXR_COMPRESSION_DWAB:
      return kDeflate * kRunLength;
    default:
      return std::nullopt;
  }
}

Error too_large(const std::string& path, const std::string& what) {
  return {ErrorCode::unsupported, what, path, "resize or split the picture"};
}

Status check_window(const ExrWindow& window, const char* name, const std::string& path) {
  if (window.width() <= kMaxSide && window.height() <= kMaxSide &&
      window.width() * window.height() <= kMaxPixels) {
    return {};
  }
  return too_large(path, std::string("its ") + name + " is " + std::to_string(window.width()) +
                             " x " + std::to_string(window.height()) +
                             " pixels, more than can be read");
}

// The number of bytes of the data window's pixels, decompressed. Subsampled channels count less.
std::uint64_t decompressed_bytes(const ExrPart& part) {
  const auto pixels = static_cast<std::uint64_t>(part.data.width() * part.data.height());
  std::uint64_t bytes = 0;
  for (const ExrChannel& channel : part.channels) {
    const auto sampling = static_cast<std::uint64_t>(channel.x_sampling) *
                          static_cast<std::uint64_t>(channel.y_sampling);
    bytes += pixels / sampling * sample_size(channel.type);
  }
  return bytes;
}

Status check_against_file(const ExrContext& context, const ExrPart& part) {
  const std::string& path = context.file().path();
  const auto rows =
      static_cast<std::uint64_t>(divide_up<std::int64_t>(part.data.height(), part.chunk_rows));
  const auto columns =
      static_cast<std::uint64_t>(divide_up<std::int64_t>(part.data.width(), part.chunk_columns));
  if (context.table(part.index).count < rows * columns) {
    return Error{ErrorCode::malformed,
                 "its table has " + std::to_string(context.table(part.index).count) +
                     " chunks, but its size needs " + std::to_string(rows * columns),
                 path, ""};
  }
  const std::uint64_t available = context.file().size() - context.first_chunk_offset();
  const std::uint64_t needed = decompressed_bytes(part);
  const auto expansion = largest_expansion(part.compression);
  if (!expansion || needed / *expansion <= available) return {};
  return Error{ErrorCode::malformed,
               "declares " + std::to_string(needed) + " bytes of pixels (" +
                   exr_compression_name(part.compression) + "), but only " +
                   std::to_string(available) + " bytes follow its header",
               path, "the file is cut off or damaged; copy it again"};
}

// Tiles count as large as they are declared: OpenEXR's C++ classes make room for all of a tile even
// if the data window is smaller.
Status check_chunk_bytes(const ExrPart& part, const ExrColour& colour, const std::string& path) {
  const std::uint64_t rows = std::max<std::uint64_t>(part.chunk_rows, part.declared_tile_height);
  const std::uint64_t columns =
      std::max<std::uint64_t>(part.chunk_columns, part.declared_tile_width);
  if (rows > kMaxSide || columns > kMaxSide) {
    return too_large(
        path, "has tiles of " + std::to_string(columns) + " x " + std::to_string(rows) + " pixels");
  }
  std::uint64_t row_of_chunks = 0;  // the colour only
  for (int i = 0; i < colour.channel_count(); ++i) {
    row_of_chunks += static_cast<std::uint64_t>(part.data.width()) * rows *
                     sample_size(part.channels[colour.channels[i]].type);
  }
  const std::uint64_t bytes = std::max(rows * columns * part.pixel_bytes(), row_of_chunks);
  if (bytes <= kMaxChunkBytes) return {};
  return too_large(path, "has chunks of " + std::to_string(bytes >> 20) +
                             " MiB, which cannot be read piece by piece");
}

// The picture's window, the data window and what both share, in the picture's coordinates.
void place(const ExrPart& part, ExrLayout& layout) {
  const ExrWindow& picture = part.envmap ? part.data : part.display;
  layout.width = static_cast<int>(picture.width());
  layout.height = static_cast<int>(picture.height());
  layout.data_width = static_cast<int>(part.data.width());
  layout.data_height = static_cast<int>(part.data.height());

  const ExrWindow shared{
      std::max(picture.x_begin, part.data.x_begin), std::max(picture.y_begin, part.data.y_begin),
      std::min(picture.x_end, part.data.x_end), std::min(picture.y_end, part.data.y_end)};
  if (shared.width() <= 0 || shared.height() <= 0) return;  // all black
  layout.data_x = part.data.x_begin - picture.x_begin;
  layout.data_y = part.data.y_begin - picture.y_begin;
  layout.visible_x_begin = shared.x_begin - picture.x_begin;
  layout.visible_x_end = shared.x_end - picture.x_begin;
  layout.visible_y_begin = shared.y_begin - picture.y_begin;
  layout.visible_y_end = shared.y_end - picture.y_begin;
}

// The rows of a band unless the caller wants a number.
int default_rows(const ExrPart& part, std::uint64_t chunk_bytes) {
  if (part.chunk_rows == 1) return kDefaultRowsOfLineChunks;
  const bool is_zlib =
      part.compression == EXR_COMPRESSION_ZIP || part.compression == EXR_COMPRESSION_PXR24;
  if (!is_zlib || part.storage != ExrStorage::scanlines) return part.chunk_rows;
  const auto chunks =
      std::clamp<std::uint64_t>(kBytesOfZlibChunks / chunk_bytes, 1, ZlibInflater::kLanes);
  return part.chunk_rows * static_cast<int>(chunks);
}

void cut_into_bands(const ExrPart& part, int rows_wanted, ExrLayout& layout) {
  layout.chunk_rows = part.chunk_rows;
  const std::uint64_t chunk_bytes = part.pixel_bytes() *
                                    static_cast<std::uint64_t>(layout.data_width) *
                                    static_cast<std::uint64_t>(part.chunk_rows);
  const auto at_most =
      static_cast<int>(std::clamp<std::uint64_t>(kMaxBandBytes / chunk_bytes, 1, kMaxSide));
  const int rows =
      rows_wanted > 0 ? std::min(rows_wanted, kMaxSide) : default_rows(part, chunk_bytes);
  const int chunks = divide_up(layout.data_height, part.chunk_rows);
  layout.chunks_per_band = std::min({divide_up(rows, part.chunk_rows), at_most, chunks});

  const int rows_per_band = layout.rows_per_band();
  layout.black_bands_above = divide_up(layout.visible_y_begin, rows_per_band);
  layout.black_bands_below = divide_up(layout.height - layout.visible_y_end, rows_per_band);
  if (layout.visible_y_begin == layout.visible_y_end) return;
  layout.first_chunk = (layout.visible_y_begin - layout.data_y) / part.chunk_rows;
  const int last_chunk = (layout.visible_y_end - 1 - layout.data_y) / part.chunk_rows;
  layout.data_bands = divide_up(last_chunk - layout.first_chunk + 1, layout.chunks_per_band);
}

}  // namespace

ExrBand ExrLayout::band(int index) const {
  const int rows = rows_per_band();
  if (index < black_bands_above) {
    return {index * rows, std::min((index + 1) * rows, visible_y_begin), 0, 0};
  }
  index -= black_bands_above;
  if (index >= data_bands) {
    const int begin = visible_y_end + (index - data_bands) * rows;
    return {begin, std::min(begin + rows, height), 0, 0};
  }
  const int last_chunk = (visible_y_end - 1 - data_y) / chunk_rows;
  const int chunk_begin = first_chunk + index * chunks_per_band;
  const int chunk_end = std::min(chunk_begin + chunks_per_band, last_chunk + 1);
  return {std::max(row_of_chunk(chunk_begin), visible_y_begin),
          std::min(row_of_chunk(chunk_end), visible_y_end), chunk_begin, chunk_end};
}

double ExrLayout::covered_fraction() const {
  return static_cast<double>(visible_x_end - visible_x_begin) / width *
         (static_cast<double>(visible_y_end - visible_y_begin) / height);
}

int ExrLayout::rows_of_chunk(int chunk) const {
  return std::min(chunk_rows, data_height - chunk * chunk_rows);
}

Result<ExrLayout> lay_out_exr(const ExrContext& context, const ExrPart& part,
                              const ExrColour& colour, int rows_wanted) {
  const std::string& path = context.file().path();
  SHOAL_RETURN_IF_ERROR(check_window(part.data, "data window", path));
  if (!part.envmap) {
    SHOAL_RETURN_IF_ERROR(check_window(part.display, "picture", path));
  }
  SHOAL_RETURN_IF_ERROR(check_against_file(context, part));
  SHOAL_RETURN_IF_ERROR(check_chunk_bytes(part, colour, path));
  ExrLayout layout;
  place(part, layout);
  cut_into_bands(part, rows_wanted, layout);
  return layout;
}

}  // namespace shoal
