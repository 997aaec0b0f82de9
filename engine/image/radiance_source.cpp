#include "image/radiance_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <vector>

#include "core/aligned_buffer.h"
#include "core/input_file.h"
#include "image/radiance_header.h"
#include "image/radiance_rle.h"

namespace shoal {
namespace {

constexpr std::size_t kWindowBytes = std::size_t{1} << 18;     // of the file, small enough for L2
constexpr std::int64_t kBandBytes = std::int64_t{1} << 18;     // all planes of a band, if not asked
constexpr std::int64_t kMaxBandBytes = std::int64_t{1} << 26;  // whatever is asked

// Where bands begin in the file, as far as anybody has come. A scanline's end is known only to who
// has gone through it, so whoever wants a band farther on goes through those before, one at a time.
class BandStarts {
 public:
  explicit BandStarts(std::uint64_t first) : offsets_{first} {}

  // The offset of band `index`. `next_start(band, offset)` finds where the band after `band`
  // begins.
  template <typename NextStart>
  Result<std::uint64_t> find(int index, const NextStart& next_start) {
    const std::scoped_lock lock(mutex_);
    while (static_cast<int>(offsets_.size()) <= index) {
      const int last = static_cast<int>(offsets_.size()) - 1;
      SHOAL_ASSIGN_OR_RETURN(offset, next_start(last, offsets_[last]));
      offsets_.push_back(offset);
    }
    return offsets_[index];
  }

  // Somebody has read band `index - 1` and so knows.
  void tell(int index, std::uint64_t offset) {
    const std::scoped_lock lock(mutex_);
    if (static_cast<int>(offsets_.size()) == index) offsets_.push_back(offset);
  }

 private:
  std::mutex mutex_;
  std::vector<std::uint64_t> offsets_;
};

// What a source and its readers share; only the starts change.
struct RadianceFile {
  InputFile file;
  RadianceHeader header;
  SampleType sample_type = SampleType::rgbe_floor;
  DataSize data_size = DataSize::any;
  int rows_per_band = 0;
  std::unique_ptr<BandStarts> starts;

  [[nodiscard]] int band_begin(int band) const { return band * rows_per_band; }
  [[nodiscard]] int band_end(int band) const {
    return std::min(band_begin(band) + rows_per_band, header.scanline_count);
  }
};

// A part of the file in memory that moves forward over it.
class Window {
 public:
  Window(const InputFile& file, std::uint64_t offset) : file_(file), next_offset_(offset) {}

  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {buffer_.data() + begin_, end_ - begin_};
  }

  // Where bytes() begin in the file.
  [[nodiscard]] std::uint64_t offset() const { return next_offset_ - (end_ - begin_); }

  void consume(std::size_t count) { begin_ += count; }

  // Goes on from `offset`; free where the window is there already.
  void move_to(std::uint64_t offset) {
    if (offset == this->offset()) return;
    begin_ = end_ = 0;
    next_offset_ = offset;
  }

  // Reads on behind what is left, with more room if it is much already. Returns how many bytes
  // came; 0 at the end of the file.
  Result<std::size_t> extend() {
    const std::size_t left = end_ - begin_;
    const std::uint64_t unread = file_.size() - std::min(file_.size(), next_offset_);
    if (unread == 0) return std::size_t{0};
    const std::size_t room = std::max(kWindowBytes, 2 * left);
    const std::size_t wanted = std::min<std::uint64_t>(unread, room - left);
    if (buffer_.size() < room + kRadianceSlack) {
      AlignedBuffer<std::uint8_t> larger;
      larger.resize_uninitialised(room + kRadianceSlack);
      if (left > 0) std::memcpy(larger.data(), buffer_.data() + begin_, left);
      buffer_ = std::move(larger);
    } else if (left > 0) {
      std::memmove(buffer_.data(), buffer_.data() + begin_, left);
    }
    begin_ = 0;
    end_ = left;
    SHOAL_ASSIGN_OR_RETURN(got, file_.read_some(next_offset_, std::as_writable_bytes(std::span(
                                                                  buffer_.data() + left, wanted))));
    next_offset_ += got;
    end_ += got;
    return got;
  }

 private:
  const InputFile& file_;
  std::uint64_t next_offset_;  // of the first byte behind the window
  AlignedBuffer<std::uint8_t> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

class RadianceReader final : public BandReader {
 public:
  explicit RadianceReader(std::shared_ptr<const RadianceFile> picture)
      : picture_(std::move(picture)), window_(picture_->file, picture_->header.data_offset) {
    const auto width = static_cast<std::size_t>(picture_->header.scanline_width);
    stride_ = (width + kAlignment - 1) / kAlignment * kAlignment + kRadianceSlack;
  }

  Result<RowBand> read(int index) override {
    const int begin = picture_->band_begin(index);
    const int end = picture_->band_end(index);
    for (auto& plane : planes_) {
      plane.resize_uninitialised(static_cast<std::size_t>(end - begin) * stride_);
    }
    SHOAL_ASSIGN_OR_RETURN(start, picture_->starts->find(index, [this](int band, std::uint64_t at) {
      return end_of_band(band, at);
    }));
    window_.move_to(start);
    for (int scanline = begin; scanline < end; ++scanline) {
      SHOAL_RETURN_IF_ERROR(take_scanline(scanline, scanline - begin, expand_radiance_scanline));
    }
    picture_->starts->tell(index + 1, window_.offset());
    return band(begin, end);
  }

 private:
  using TakeScanline = decltype(&expand_radiance_scanline);

  // Where the band after `band` begins, `band` itself beginning at `start`.
  Result<std::uint64_t> end_of_band(int band, std::uint64_t start) {
    window_.move_to(start);
    for (int scanline = picture_->band_begin(band); scanline < picture_->band_end(band);
         ++scanline) {
      SHOAL_RETURN_IF_ERROR(take_scanline(scanline, 0, skip_radiance_scanline));
    }
    return window_.offset();
  }

  [[nodiscard]] int count() const { return picture_->header.scanline_count; }

  // A scanline that the window's end cuts is taken again when more of the file is there.
  Status take_scanline(int scanline, int buffer_row, TakeScanline take) {
    const std::size_t offset = static_cast<std::size_t>(buffer_row) * stride_;
    const std::array<std::uint8_t*, 4> planes = {
        planes_[0].data() + offset, planes_[1].data() + offset, planes_[2].data() + offset,
        planes_[3].data() + offset};
    for (;;) {
      const auto result =
          take(window_.bytes(), picture_->header.scanline_width, picture_->data_size, planes);
      if (result.state == ScanlineState::whole) {
        window_.consume(result.bytes);
        return {};
      }
      if (result.state == ScanlineState::broken) return failure(scanline, result.fault);
      SHOAL_ASSIGN_OR_RETURN(got, window_.extend());
      if (got == 0) return failure(scanline, "is cut off by the end of the file");
    }
  }

  [[nodiscard]] Error failure(int scanline, std::string_view fault) const {
    const auto& header = picture_->header;
    const int place = header.scanlines_reversed ? count() - 1 - scanline : scanline;
    return Error{ErrorCode::malformed,
                 fmt::format("{} {} {}; {} of {} are good",
                             header.scan_axis == ScanAxis::rows ? "row" : "column", place, fault,
                             scanline, count()),
                 fmt::format("{}:{}", picture_->file.path(), place),
                 "copy or write the file again"};
  }

  // The buffers hold scanlines as the file orders them; the band ascends in the picture.
  [[nodiscard]] RowBand band(int begin, int end) const {
    const auto& header = picture_->header;
    RowBand band;
    band.row_begin = header.scanlines_reversed ? count() - end : begin;
    band.row_end = header.scanlines_reversed ? count() - begin : end;
    band.width = header.scanline_width;
    band.channel_count = 3;
    for (int c = 0; c < 3; ++c) band.channels[c] = plane(planes_[c], end - begin);
    band.exponent = plane(planes_[3], end - begin);
    return band;
  }

  [[nodiscard]] Plane plane(const AlignedBuffer<std::uint8_t>& buffer, int rows) const {
    const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
    const auto stride = static_cast<std::ptrdiff_t>(stride_);
    if (!picture_->header.scanlines_reversed) return {data, stride, picture_->sample_type};
    return {data + (rows - 1) * stride, -stride, picture_->sample_type};
  }

  std::shared_ptr<const RadianceFile> picture_;
  Window window_;
  std::size_t stride_ = 0;
  std::array<AlignedBuffer<std::uint8_t>, 4> planes_;
};

int choose_rows_per_band(const RadianceHeader& header, int wish) {
  const std::int64_t row_bytes = 4 * std::int64_t{header.scanline_width};
  const std::int64_t chosen =
      wish > 0 ? std::min<std::int64_t>(wish, kMaxBandBytes / row_bytes) : kBandBytes / row_bytes;
  return static_cast<int>(std::clamp<std::int64_t>(chosen, 1, header.scanline_count));
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
  info.rows_per_band = picture.rows_per_band;
  info.band_count = (header.scanline_count - 1) / picture.rows_per_band + 1;
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

}  // namespace

Result<std::unique_ptr<PanoramaSource>> open_radiance(const std::filesystem::path& path,
                                                      const ReadOptions& options) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
  SHOAL_ASSIGN_OR_RETURN(header, read_radiance_header(file));
  auto picture = std::make_shared<RadianceFile>();
  picture->sample_type =
      options.rgbe_decode == RgbeDecode::center ? SampleType::rgbe_center : SampleType::rgbe_floor;
  const auto flat_bytes =
      4 * static_cast<std::uint64_t>(header.scanline_count) * header.scanline_width;
  if (file.size() - header.data_offset == flat_bytes) picture->data_size = DataSize::of_flat;
  picture->rows_per_band = choose_rows_per_band(header, options.rows_per_band);
  picture->starts = std::make_unique<BandStarts>(header.data_offset);
  picture->file = std::move(file);
  picture->header = std::move(header);
  return std::unique_ptr<PanoramaSource>(std::make_unique<RadianceSource>(std::move(picture)));
}

}  // namespace shoal
