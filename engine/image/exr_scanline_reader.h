// EXR scanline parts in the compressions that we expand ourselves: the hot path.
//
// A chunk of such a part is, line after line, one channel after the other: planar rows already. The
// planes of a band point into the expanded chunks, or into the bytes as read from the file.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/aligned_buffer.h"
#include "image/exr_band_reader.h"
#include "image/exr_inflate.h"

namespace shoal {

class ExrScanlineReader final : public ExrBandReader {
 public:
  // Whether parts like this are read here.
  static bool can_read(const ExrPart& part, const ExrColour& colour);

  // Precondition: picture->chunks has been read.
  explicit ExrScanlineReader(std::shared_ptr<const ExrPicture> picture);

 private:
  // The lines of a band's chunks, all channels, `stride` bytes from one to the next.
  struct Lines {
    const std::byte* first = nullptr;
    std::ptrdiff_t stride = 0;
  };

  Status decode(const ExrBand& band, RowBand& rows) override;
  Status fetch(const ExrBand& band);
  Result<std::span<const std::byte>> open_chunk(int chunk, std::span<const std::byte> bytes) const;
  [[nodiscard]] std::optional<Lines> lines_as_fetched(const ExrBand& band) const;
  Result<Lines> expand(const ExrBand& band);
  void show(const ExrBand& band, const Lines& lines, RowBand& rows);
  [[nodiscard]] std::size_t expanded_size(int chunk) const;
  [[nodiscard]] Error damaged(int chunk, const std::string& what) const;

  std::size_t line_bytes_ = 0;                          // of all channels
  std::array<std::ptrdiff_t, kMaxChannels> in_line_{};  // where a channel begins in a line
  std::vector<SampleType> types_;                       // of all channels
  ExrInflater inflater_;
  AlignedBuffer<std::byte> fetched_;
  std::vector<std::span<const std::byte>> packed_;  // the band's chunks in fetched_, no leaders
  std::vector<ExrInflater::Chunk> chunks_;          // the band's, on their way to expanded_
  AlignedBuffer<std::byte> expanded_;
  std::optional<ExrPlanarRows> widened_;  // only where the data window is narrower than the picture
};

}  // namespace shoal
