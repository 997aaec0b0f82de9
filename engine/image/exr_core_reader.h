// EXR scanlines and tiles in the compressions that OpenEXRCore decodes for us: B44, B44A, and with
// newer versions of the library DWAA and DWAB.
#pragma once

#include <openexr.h>

#include "image/exr_band_reader.h"

namespace shoal {

class ExrCoreReader final : public ExrBandReader {
 public:
  // Whether parts like this are read here.
  static bool can_read(const ExrPart& part, const ExrColour& colour);

  explicit ExrCoreReader(std::shared_ptr<const ExrPicture> picture);
  ~ExrCoreReader() override;

 private:
  Status decode(const ExrBand& band, RowBand& rows) override;
  Status decode_tiles(int chunk, int first_row);
  Status decode_chunk(const exr_chunk_info_t& info, int row, int column, const std::string& where);
  exr_result_t aim_pipeline(const exr_chunk_info_t& info, int row, int column);

  ExrPlanarRows rows_;
  // One pipeline for all chunks: it keeps its buffers. It points into itself, so it must not move.
  exr_decode_pipeline_t pipeline_{};
  decltype(exr_decode_pipeline_t::decompress_fn) decompress_ = nullptr;
};

}  // namespace shoal
