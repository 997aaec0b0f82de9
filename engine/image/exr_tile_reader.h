// EXR tiles in the compressions that we expand ourselves, laid side by side.
#pragma once

#include <openexr.h>

#include <span>
#include <string>
#include <vector>

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
  Status decode_tiles(int tile_row, ExrLayout::Columns columns, int first_row);
  Status locate(int tile_row, ExrLayout::Columns columns, const std::string& where);
  Status fetch();
  void place(const exr_chunk_info_t& info, std::span<const std::byte> tile, int row, int column);
  [[nodiscard]] std::size_t expanded_size(const exr_chunk_info_t& tile) const;
  [[nodiscard]] Error damaged(const std::string& where) const;

  ExrPlanarRows rows_;
  std::vector<int> band_channel_;  // of a channel of the file: its number in the bands, or -1
  std::vector<SampleType> types_;  // of all channels of the file
  int tiles_together_ = 1;
  ExrInflater inflater_;
  // The tiles that are decoded together: where they are in the file, and on their way from packed_
  // to expanded_.
  std::vector<exr_chunk_info_t> tiles_;
  std::vector<ExrInflater::Chunk> chunks_;
  AlignedBuffer<std::byte> packed_;
  AlignedBuffer<std::byte> expanded_;
};

}  // namespace shoal
