// EXR tiles without compression or with RLE, ZIPS, ZIP: expanded by us, then laid side by side.
#pragma once

#include <openexr.h>

#include <span>

#include "core/aligned_buffer.h"
#include "image/exr_band_reader.h"
#include "image/exr_inflate.h"

namespace shoal {

class ExrTileReader final : public ExrBandReader {
 public:
  // Whether parts like this are read here.
  static bool can_read(const ExrPart& part, const ExrColour& colour);

  explicit ExrTileReader(std::shared_ptr<const ExrPicture> picture);

 private:
  Status decode(const ExrBand& band, RowBand& rows) override;
  Status decode_tile(int tile_row, int tile_column, int first_row);
  Result<std::span<const std::byte>> fetch(const exr_chunk_info_t& info, const std::string& where);
  void place(const exr_chunk_info_t& info, std::span<const std::byte> tile, int row, int column);

  ExrPlanarRows rows_;
  std::vector<int> band_channel_;  // of a channel of the file: its number in the bands, or -1
  ExrInflater inflater_;
  AlignedBuffer<std::byte> packed_;
  AlignedBuffer<std::byte> expanded_;
};

}  // namespace shoal
