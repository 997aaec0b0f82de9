#include "image/exr_tile_reader.h"

#include <cstring>

namespace shoal {

bool ExrTileReader::can_read(const ExrPart& part, const ExrColour& colour) {
  return part.storage == ExrStorage::tiles && !part.has_subsampling() &&
         colour.model != ExrColourModel::luminance_chroma &&
         ExrInflater::can_expand(part.compression);
}

ExrTileReader::ExrTileReader(std::shared_ptr<const ExrPicture> picture_in)
    : ExrBandReader(std::move(picture_in)),
      rows_(picture()),
      band_channel_(picture().part.channels.size(), -1),
      inflater_(picture().part.compression, picture().codecs) {
  for (int c = 0; c < picture().colour.channel_count(); ++c) {
    band_channel_[picture().colour.channels[c]] = c;
  }
}

Status ExrTileReader::decode(const ExrBand& band, RowBand& rows) {
  for (int tile_row = band.chunk_begin; tile_row < band.chunk_end; ++tile_row) {
    const int first_row = (tile_row - band.chunk_begin) * layout().chunk_rows;
    const ExrLayout::Columns columns = layout().visible_tiles(picture().part.chunk_columns);
    for (int column = columns.begin; column < columns.end; ++column) {
      SHOAL_RETURN_IF_ERROR(decode_tile(tile_row, column, first_row));
    }
  }
  rows_.show(band, rows);
  return {};
}

Status ExrTileReader::decode_tile(int tile_row, int tile_column, int first_row) {
  const std::string where = picture().where(layout().row_of_chunk(tile_row));
  exr_chunk_info_t info{};
  SHOAL_RETURN_IF_ERROR(picture().context->run(where, [&] {
    return exr_read_tile_chunk_info(picture().context->handle(), picture().part.index, tile_column,
                                    tile_row, 0, 0, &info);
  }));
  SHOAL_ASSIGN_OR_RETURN(tile, fetch(info, where));
  place(info, tile, first_row, tile_column * picture().part.chunk_columns);
  return {};
}

// The tile's pixels, line after line, one channel after the other.
Result<std::span<const std::byte>> ExrTileReader::fetch(const exr_chunk_info_t& info,
                                                        const std::string& where) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(info.width) * static_cast<std::uint64_t>(info.height);
  const std::uint64_t size = pixels * picture().part.pixel_bytes();
  const Error damaged{ErrorCode::malformed,
                      "the pixels of a tile do not decompress (" +
                          exr_compression_name(picture().part.compression) + ")",
                      where, "the file is damaged; copy it again"};
  if (info.packed_size > size) return damaged;
  packed_.resize_uninitialised(info.packed_size);
  SHOAL_RETURN_IF_ERROR(picture().context->file().read_exactly(info.data_offset, packed_.span()));
  if (info.packed_size == size) return std::span<const std::byte>(packed_.span());
  expanded_.resize_uninitialised(size);
  if (inflater_.expand(packed_.span(), expanded_.span()) != Expansion::done) return damaged;
  return std::span<const std::byte>(expanded_.span());
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
