#include "image/exr_core_reader.h"

#include <OpenEXRConfig.h>

#include <cstddef>
#include <span>

namespace shoal {
namespace {

// The C library of OpenEXR 3.1 does not implement DWAA and DWAB.
constexpr bool kCoreDecodesDwa = OPENEXR_VERSION_MAJOR > 3 ||
                                 (OPENEXR_VERSION_MAJOR == 3 && OPENEXR_VERSION_MINOR >= 2);

// Takes the place of the library's decompression; `decoding_user_data` is our inflater.
exr_result_t inflate(exr_decode_pipeline_t* pipeline) {
  auto& inflater = *static_cast<ExrInflater*>(pipeline->decoding_user_data);
  const std::span packed(static_cast<const std::byte*>(pipeline->packed_buffer),
                         pipeline->chunk.packed_size);
  const std::span out(static_cast<std::byte*>(pipeline->unpacked_buffer),
                      pipeline->chunk.unpacked_size);
  return inflater.expand(packed, out) == Expansion::done ? EXR_ERR_SUCCESS : EXR_ERR_CORRUPT_CHUNK;
}

}  // namespace

bool ExrCoreReader::can_read(const ExrPart& part, const ExrColour& colour) {
  if (colour.model == ExrColourModel::luminance_chroma || part.has_subsampling()) return false;
  const bool is_dwa =
      part.compression == EXR_COMPRESSION_DWAA || part.compression == EXR_COMPRESSION_DWAB;
  return kCoreDecodesDwa || !is_dwa;
}

ExrCoreReader::ExrCoreReader(std::shared_ptr<const ExrPicture> picture_in)
    : ExrBandReader(std::move(picture_in)), rows_(picture()) {}

ExrCoreReader::~ExrCoreReader() {
  if (pipeline_.context) exr_decoding_destroy(pipeline_.context, &pipeline_);
}

Status ExrCoreReader::decode(const ExrBand& band, RowBand& rows) {
  for (int chunk = band.chunk_begin; chunk < band.chunk_end; ++chunk) {
    const int row = (chunk - band.chunk_begin) * layout().chunk_rows;
    if (picture().part.storage == ExrStorage::tiles) {
      SHOAL_RETURN_IF_ERROR(decode_tiles(chunk, row));
      continue;
    }
    const std::string where = picture().where(layout().row_of_chunk(chunk));
    exr_chunk_info_t info{};
    SHOAL_RETURN_IF_ERROR(picture().context->run(where, [&] {
      return exr_read_scanline_chunk_info(picture().context->handle(), picture().part.index,
                                          picture().part.data.y_begin + chunk * layout().chunk_rows,
                                          &info);
    }));
    SHOAL_RETURN_IF_ERROR(decode_chunk(info, row, 0, where));
  }
  rows_.show(band, rows);
  return {};
}

// Decodes the tiles of row `chunk` that show in the picture to `first_row` of our rows.
Status ExrCoreReader::decode_tiles(int chunk, int first_row) {
  const int tile_width = picture().part.chunk_columns;
  const int first = (layout().visible_x_begin - layout().data_x) / tile_width;
  const int last = (layout().visible_x_end - 1 - layout().data_x) / tile_width;
  const std::string where = picture().where(layout().row_of_chunk(chunk));
  for (int tile = first; tile <= last; ++tile) {
    exr_chunk_info_t info{};
    SHOAL_RETURN_IF_ERROR(picture().context->run(where, [&] {
      return exr_read_tile_chunk_info(picture().context->handle(), picture().part.index, tile,
                                      chunk, 0, 0, &info);
    }));
    SHOAL_RETURN_IF_ERROR(decode_chunk(info, first_row, tile * tile_width, where));
  }
  return {};
}

Status ExrCoreReader::decode_chunk(const exr_chunk_info_t& info, int row, int column,
                                   const std::string& where) {
  const ExrContext& context = *picture().context;
  const bool stored_as_is = info.packed_size == info.unpacked_size;
  if (picture().part.compression == EXR_COMPRESSION_NONE && !stored_as_is) {
    return Error{ErrorCode::malformed, "the pixels of this chunk are cut off", where,
                 "the file is damaged; copy it again"};
  }
  SHOAL_RETURN_IF_ERROR(context.run(where, [&] { return aim_pipeline(info, row, column); }));
  // A chunk that did not become smaller is stored as it is, in every compression; the library (3.1)
  // would decompress it nevertheless if it is B44.
  pipeline_.decompress_fn = stored_as_is ? nullptr : decompress_;
  return context.run(
      where, [&] { return exr_decoding_run(context.handle(), picture().part.index, &pipeline_); });
}

// Makes the pipeline decode the chunk `info` to `row` and `column` of our rows.
exr_result_t ExrCoreReader::aim_pipeline(const exr_chunk_info_t& info, int row, int column) {
  const exr_const_context_t context = picture().context->handle();
  const int part = picture().part.index;
  const bool is_first = pipeline_.context == nullptr;
  const exr_result_t result = is_first ? exr_decoding_initialize(context, part, &info, &pipeline_)
                                       : exr_decoding_update(context, part, &info, &pipeline_);
  if (result != EXR_ERR_SUCCESS) return result;
  for (int c = 0; c < picture().colour.channel_count(); ++c) {
    // The library keeps the channels in the order of the header.
    exr_coding_channel_info_t& channel = pipeline_.channels[picture().colour.channels[c]];
    channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(rows_.sample(c, row, column));
    channel.user_pixel_stride = channel.bytes_per_element;
    channel.user_line_stride = static_cast<std::int32_t>(rows_.row_stride(c));
  }
  return is_first ? choose_routines() : EXR_ERR_SUCCESS;
}

exr_result_t ExrCoreReader::choose_routines() {
  const exr_result_t result = exr_decoding_choose_default_routines(
      picture().context->handle(), picture().part.index, &pipeline_);
  decompress_ = pipeline_.decompress_fn;
  const exr_compression_t compression = picture().part.compression;
  if (compression == EXR_COMPRESSION_RLE || compression == EXR_COMPRESSION_ZIPS ||
      compression == EXR_COMPRESSION_ZIP) {
    pipeline_.decoding_user_data = &inflater_.emplace(compression, picture().codecs);
    decompress_ = &inflate;
  }
  return result;
}

}  // namespace shoal
