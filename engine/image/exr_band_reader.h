// What the ways of reading EXR bands have in common.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/aligned_buffer.h"
#include "core/row_band.h"
#include "image/chunk_codecs.h"
#include "image/exr_chunk_table.h"
#include "image/exr_context.h"
#include "image/exr_layout.h"
#include "image/exr_part.h"
#include "image/exr_selection.h"
#include "image/panorama_source.h"

namespace shoal {

// An EXR panorama as its readers share it: immutable.
struct ExrPicture {
  std::shared_ptr<const ExrContext> context;
  ExrPart part;
  ExrColour colour;
  ExrLayout layout;
  std::string layer;
  ChunkCodecs codecs;
  ExrChunkTable chunks;  // empty unless ExrScanlineReader reads the part

  // "path:row", the row being one of the picture.
  [[nodiscard]] std::string where(int row) const;
  // Of channel `channel` of the bands.
  [[nodiscard]] SampleType sample_type(int channel) const;
};

class ExrBandReader : public BandReader {
 public:
  Result<RowBand> read(int index) final;

 protected:
  explicit ExrBandReader(std::shared_ptr<const ExrPicture> picture);
  [[nodiscard]] const ExrPicture& picture() const { return *picture_; }
  [[nodiscard]] const ExrLayout& layout() const { return picture_->layout; }

  // Decodes `band`, which is not black. Sets data and row_stride of the planes of `rows` so that
  // they begin with the first sample of row band.row_begin of the picture; all else is set already.
  virtual Status decode(const ExrBand& band, RowBand& rows) = 0;

 private:
  std::shared_ptr<const ExrPicture> picture_;
  AlignedBuffer<std::byte> black_row_;
};

// Planar rows of all channels of a band, as wide as the picture and the data window together, black
// where the data window does not reach. Row 0 is the first row of the band's first chunk.
class ExrPlanarRows {
 public:
  // Room for chunks_per_band chunk rows; allocates.
  explicit ExrPlanarRows(const ExrPicture& picture);

  [[nodiscard]] std::ptrdiff_t row_stride(int channel) const { return channels_[channel].stride; }
  // The sample of `row` that is `column` columns right of the data window's left border.
  [[nodiscard]] std::byte* sample(int channel, int row, int column = 0);
  // Points the band's planes at the rows.
  void show(const ExrBand& band, RowBand& rows) const;

 private:
  struct Channel {
    std::size_t offset = 0;  // of row 0 in samples_
    std::ptrdiff_t stride = 0;
    std::ptrdiff_t sample_bytes = 0;
  };
  const ExrLayout& layout_;
  int left_ = 0;  // the picture's column where rows begin, <= 0
  std::array<Channel, kMaxChannels> channels_;
  AlignedBuffer<std::byte> samples_;
};

}  // namespace shoal
