#include "image/radiance_source.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "image/radiance_reader.h"

namespace shoal {
namespace {

// Expanded bytes of a band, which shares L2 with the bytes that it is expanded from.
constexpr std::int64_t kBandBytes = std::int64_t{1} << 18;
// A worker that finds its own start in the file reads half a scanline in vain, which should be
// little of its piece.
constexpr int kMinScanlines = 8;
// Where much of a file is alike, bands become larger than the average, but not larger than this.
constexpr std::int64_t kMaxUnaskedBandBytes = std::int64_t{1} << 23;
constexpr std::int64_t kMaxBandBytes = std::int64_t{1} << 26;  // whatever is asked

int scanlines_in(std::int64_t bytes, const RadianceHeader& header) {
  const std::int64_t scanlines = bytes / (4 * std::int64_t{header.scanline_width});
  return static_cast<int>(std::clamp<std::int64_t>(scanlines, 1, header.scanline_count));
}

// A wish of so many scanlines is met exactly: one piece, of which each band has the most it may.
RadianceCut choose_cut(const RadianceHeader& header, std::uint64_t data_bytes, int wish) {
  if (wish > 0) {
    return {std::numeric_limits<std::uint64_t>::max(),
            std::min(wish, scanlines_in(kMaxBandBytes, header))};
  }
  const auto count = static_cast<std::uint64_t>(header.scanline_count);
  const auto usual =
      static_cast<std::uint64_t>(std::min(std::max(scanlines_in(kBandBytes, header), kMinScanlines),
                                          scanlines_in(kMaxUnaskedBandBytes, header)));
  return {std::max<std::uint64_t>(1, (data_bytes * usual + count - 1) / count),
          scanlines_in(kMaxUnaskedBandBytes, header)};
}

// A file that begins with a scanline in new RLE is expected to go on so, and one that has the size
// of a flat file to be one. Expected wrongly, it is read more slowly.
Result<StartGuess> choose_guess(const RadianceFile& picture) {
  std::array<std::uint8_t, 4> first{};
  SHOAL_ASSIGN_OR_RETURN(got, picture.file.read_some(picture.header.data_offset,
                                                     std::as_writable_bytes(std::span(first))));
  const int width = picture.header.scanline_width;
  if (got == first.size() && allows_new_rle(width) && first == new_rle_marker(width)) {
    return StartGuess::marker;
  }
  return picture.data_size == DataSize::of_flat ? StartGuess::stride : StartGuess::none;
}

PictureInfo describe(const RadianceFile& picture) {
  const auto& header = picture.header;
  PictureInfo info;
  info.format = header.colour == RadianceColour::xyze ? "Radiance XYZE" : "Radiance RGBE";
  const bool by_rows = header.scan_axis == ScanAxis::rows;
  info.width = by_rows ? header.scanline_width : header.scanline_count;
  info.height = by_rows ? header.scanline_count : header.scanline_width;
  info.channel_count = 3;
  info.scan_axis = header.scan_axis;
  info.samples_reversed = header.samples_reversed;
  info.rows_per_band = picture.pieces->division().max_scanlines;
  info.band_count = picture.pieces->count();
  info.band_access = BandAccess::random;
  info.to_linear_rec709 = header.to_linear_rec709;
  info.warnings = header.warnings;
  return info;
}

class RadianceSource final : public PanoramaSource {
 public:
  explicit RadianceSource(std::shared_ptr<const RadianceFile> picture)
      : picture_(std::move(picture)), info_(describe(*picture_)) {}

  [[nodiscard]] const PictureInfo& info() const override { return info_; }

  [[nodiscard]] Result<std::unique_ptr<BandReader>> new_reader() const override {
    return std::unique_ptr<BandReader>(std::make_unique<RadianceReader>(picture_));
  }

 private:
  std::shared_ptr<const RadianceFile> picture_;
  PictureInfo info_;
};

Result<std::unique_ptr<PanoramaSource>> open_cut(const std::filesystem::path& path,
                                                 const ReadOptions& options,
                                                 const std::optional<RadianceCut>& asked) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path, options.recorder));
  SHOAL_ASSIGN_OR_RETURN(header, read_radiance_header(file));
  auto picture = std::make_shared<RadianceFile>();
  picture->sample_type =
      options.rgbe_decode == RgbeDecode::center ? SampleType::rgbe_center : SampleType::rgbe_floor;
  const std::uint64_t data_bytes = file.size() - header.data_offset;
  const auto flat_bytes =
      4 * static_cast<std::uint64_t>(header.scanline_count) * header.scanline_width;
  if (data_bytes == flat_bytes) picture->data_size = DataSize::of_flat;
  const RadianceCut cut = asked ? *asked : choose_cut(header, data_bytes, options.rows_per_band);
  picture->pieces = std::make_unique<RadiancePieces>(PieceDivision{
      header.data_offset, file.size(), cut.piece_bytes, header.scanline_count, cut.max_scanlines});
  picture->file = std::move(file);
  picture->header = std::move(header);
  SHOAL_ASSIGN_OR_RETURN(guess, choose_guess(*picture));
  picture->start_guess = guess;
  return std::unique_ptr<PanoramaSource>(std::make_unique<RadianceSource>(std::move(picture)));
}

}  // namespace

Result<std::unique_ptr<PanoramaSource>> open_radiance(const std::filesystem::path& path,
                                                      const ReadOptions& options) {
  return open_cut(path, options, std::nullopt);
}

Result<std::unique_ptr<PanoramaSource>> open_radiance(const std::filesystem::path& path,
                                                      const ReadOptions& options,
                                                      const RadianceCut& cut) {
  return open_cut(path, options, cut);
}

}  // namespace shoal
