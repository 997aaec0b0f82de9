// Bands of one Radiance file; as many readers at once as there are workers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/aligned_buffer.h"
#include "core/input_file.h"
#include "image/panorama_source.h"
#include "image/radiance_header.h"
#include "image/radiance_pieces.h"
#include "image/radiance_rle.h"
#include "image/radiance_window.h"

namespace shoal {

// How a scanline that nobody has come to yet may be found.
enum class StartGuess {
  none,    // old RLE: a scanline begins like any pixel
  marker,  // new RLE: four bytes that are the same for all scanlines
  stride,  // flat: all scanlines have the same length
};

// What a source and its readers share; only the pieces change, and guard themselves.
struct RadianceFile {
  InputFile file;
  RadianceHeader header;
  SampleType sample_type = SampleType::rgbe_floor;
  DataSize data_size = DataSize::any;
  StartGuess start_guess = StartGuess::none;
  std::unique_ptr<RadiancePieces> pieces;
};

// Band k has the scanlines of piece k.
class RadianceReader final : public BandReader {
 public:
  explicit RadianceReader(std::shared_ptr<const RadianceFile> picture);

  Result<RowBand> read(int index) override;

 private:
  using TakeScanline = decltype(&expand_radiance_scanline);

  Result<std::optional<PieceRun>> run_ahead(int piece);
  Result<std::optional<PieceRun>> begin_at_marker(int piece);
  Result<bool> seek_marker(std::uint64_t end);
  Result<bool> is_at_marker_or_end();
  Result<PieceStart> await_start(int piece);
  Result<PieceRun> run_from(int piece, const PieceStart& start, TakeScanline take);
  Status go_on(int piece, int most, TakeScanline take, PieceRun& run);
  Result<const char*> take_scanline(int buffer_row, TakeScanline take);
  void limit_window(int piece);

  [[nodiscard]] Error failure(const BrokenScanline& broken) const;
  [[nodiscard]] RowBand band(int begin, int end) const;
  [[nodiscard]] Plane plane(const AlignedBuffer<std::uint8_t>& buffer, int rows) const;
  [[nodiscard]] std::array<std::uint8_t, 4> marker() const;

  std::shared_ptr<const RadianceFile> picture_;
  RadiancePieces& pieces_;
  RadianceWindow window_;
  std::size_t stride_ = 0;
  // R, G, B, E of as many scanlines as a piece may have, and of one that is only gone through.
  std::array<AlignedBuffer<std::uint8_t>, 4> planes_;
};

}  // namespace shoal
