#include "image/exr_tile_reader.h"

#include <algorithm>
#include <cstring>

namespace shoal {
namespace {

// Tiles that are expanded together: enough for ExrInflater, if they do not need much memory.
constexpr std::uint64_t kMostTiles = 16;
constexpr std::uint64_t kBytesOfTiles = 4 << 20;

int tiles_together(const ExrPart& part) {
  const std::uint64_t bytes = part.pixel_bytes() * static_cast<std::uint64_t>(part.chunk_rows) *
                              static_cast<std::uint64_t>(part.chunk_columns);
  return static_cast<int>(std::clamp<std::uint64_t>(kBytesOfTiles / bytes, 1, kMostTiles));
}

}  // namespace

bool ExrTileReader::can_read(const ExrPart& part, const ExrColour& colour) {
  return part.storage == ExrStorage::tiles && !part.has_subsampling() &&
         colour.model != ExrColourModel::luminance_chroma &&
         ExrInflater::can_expand(part.compression);
}

ExrTileReader::ExrTileReader(std::shared_ptr<const ExrPicture> picture_in)
    : ExrBandReader(std::move(picture_in)),
      rows_(picture()),
      band_channel_(picture().part.channels.size(), -1),
      types_(picture().part.sample_types()),
      tiles_together_(tiles_together(picture().part)),
      inflater_(picture().part.compression, picture().codecs) {
  for (int c = 0; c < picture().colour.channel_count(); ++c) {
    band_channel_[picture().colour.channels[c]] = c;
  }
}

Status ExrTileReader::decode(const ExrBand& band, RowBand& rows) {
  const ExrLayout::Columns columns = layout().visible_tiles(picture().part.chunk_columns);
  for (int tile_row = band.chunk_begin; tile_row < band.chunk_end; ++tile_row) {
    const int first_row = (tile_row - band.chunk_begin) * layout().chunk_rows;
    for (int column = columns.begin; column < columns.end; column += tiles_together_) {
      const int end = std::min(column + tiles_together_, columns.end);
      SHOAL_RETURN_IF_ERROR(decode_tiles(tile_row, {column, end}, first_row));
    }
  }
  rows_.show(band, rows);
  return {};
}

Status ExrTileReader::decode_tiles(int tile_row, ExrLayout::Columns columns, int first_row) {
  const std::string where = picture().where(layout().row_of_chunk(tile_row));
  SHOAL_RETURN_IF_ERROR(locate(tile_row, columns, where));
  SHOAL_RETURN_IF_ERROR(fetch());
  if (inflater_.expand(chunks_) != chunks_.size()) return damaged(where);
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const int column = columns.begin + static_cast<int>(i);
    place(tiles_[i], chunks_[i].out, first_row, column * picture().part.chunk_columns);
  }
  return {};
}

// Where the tiles lie in the file, and how large they are.
Status ExrTileReader::locate(int tile_row, ExrLayout::Columns columns, const std::string& where) {
  tiles_.clear();
  for (int column = columns.begin; column < columns.end; ++column) {
    exr_chunk_info_t info{};
    SHOAL_RETURN_IF_ERROR(picture().context->run(where, [&] {
      return exr_read_tile_chunk_info(picture().context->handle(), picture().part.index, column,
                                      tile_row, 0, 0, &info);
    }));
    if (info.packed_size > expanded_size(info)) return damaged(where);
    tiles_.push_back(info);
  }
  return {};
}

Status ExrTileReader::fetch() {
  std::size_t packed = 0;
  std::size_t expanded = 0;
  for (const exr_chunk_info_t& tile : tiles_) {
    packed += tile.packed_size;
    expanded += expanded_size(tile);
  }
  packed_.resize_uninitialised(packed);
  expanded_.resize_uninitialised(expanded);
  packed = expanded = 0;
  chunks_.clear();
  for (const exr_chunk_info_t& tile : tiles_) {
    const auto bytes = packed_.span().subspan(packed, tile.packed_size);
    SHOAL_RETURN_IF_ERROR(picture().context->file().read_exactly(tile.data_offset, bytes));
    const ExrChunkShape shape{types_, static_cast<std::size_t>(tile.width),
                              static_cast<std::size_t>(tile.height)};
    chunks_.push_back({bytes, shape, expanded_.span().subspan(expanded, expanded_size(tile))});
    packed += tile.packed_size;
    expanded += expanded_size(tile);
  }
  return {};
}

std::size_t ExrTileReader::expanded_size(const exr_chunk_info_t& tile) const {
  return static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height) *
         picture().part.pixel_bytes();
}

Error ExrTileReader::damaged(const std::string& where) const {
  return {ErrorCode::malformed,
          "the pixels of a tile do not decompress (" +
              exr_compression_name(picture().part.compression) + ")",
          where, "the file is damaged; copy it again"};
}

void ExrTileReader::place(const exr_chunk_info_t& info, std::span<const std::byte> tile, int row,
                          int column) {
  const std::vector<ExrChannel>& channels = picture().part.channels;
  const std::byte* from = tile.data();
  for (int y = 0; y < info.height; ++y) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const std::size_t bytes =
          static_cast<std::size_t>(info.width) * sample_size(channels[i].type);
      if (band_channel_[i] >= 0) {
        std::memcpy(rows_.sample(band_channel_[i], row + y, column), from, bytes);
      }
      from += bytes;
    }
  }
}

}  // namespace shoal
