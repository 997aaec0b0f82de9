#include "image/exr_imf_reader.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgba.h>
#include <ImfRgbaFile.h>

#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>

namespace shoal {
namespace {

constexpr int kInThisThread = 0;  // the library's thread count: the caller's thread does the work

// Reads through the file that is open already, with a position of its own.
class FileStream final : public Imf::IStream {
 public:
  explicit FileStream(const InputFile& file) : Imf::IStream(file.path().c_str()), file_(file) {}

  bool read(char bytes[], int count) override {
    const std::span<char> out(bytes, static_cast<std::size_t>(count));
    const auto got = file_.read_some(position_, std::as_writable_bytes(out));
    if (!got) throw std::runtime_error(got.error().what);
    if (*got < out.size()) throw std::runtime_error("ends before its data does");
    position_ += *got;
    return position_ < file_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const InputFile& file_;
  std::uint64_t position_ = 0;
};

// Runs `call`; what it throws becomes an error at `where`.
template <typename Call>
Status at_border(const std::string& where, Call&& call) {
  try {
    call();
    return {};
  } catch (const std::exception& exception) {
    return Error{ErrorCode::malformed, exception.what(), where,
                 "the file is damaged; copy it again"};
  }
}

Imf::PixelType pixel_type(SampleType type) {
  if (type == SampleType::half) return Imf::HALF;
  return type == SampleType::float32 ? Imf::FLOAT : Imf::UINT;
}

// The library finds pixel (x, y) at base + x * x_stride + y * y_stride. This is the base for which
// (x, y) lies at `at`; it is no address of ours, so it is computed as a number.
template <typename T>
T* base_for(void* at, std::int64_t x, std::ptrdiff_t x_stride, std::int64_t y,
            std::ptrdiff_t y_stride) {
  return reinterpret_cast<T*>(reinterpret_cast<std::intptr_t>(at) - x * x_stride - y * y_stride);
}

// The header has been read twice, by different code: what our memory is laid out by must be the
// same.
void require_same(const Imf::Header& header, const ExrPart& part) {
  const Imath::Box2i& window = header.dataWindow();
  bool same = window.min.x == part.data.x_begin && window.min.y == part.data.y_begin &&
              window.max.x == part.data.x_end - 1 && window.max.y == part.data.y_end - 1;
  for (const ExrChannel& channel : part.channels) {
    const Imf::Channel* found = header.channels().findChannel(channel.name);
    same = same && found && found->type == pixel_type(channel.type) &&
           found->xSampling == channel.x_sampling && found->ySampling == channel.y_sampling;
  }
  if (!same) throw std::runtime_error("its header contradicts itself");
}

class ImfReader final : public ExrBandReader {
 public:
  explicit ImfReader(std::shared_ptr<const ExrPicture> picture_in)
      : ExrBandReader(std::move(picture_in)),
        rows_(picture()),
        stream_(picture().context->file()),
        file_(stream_, kInThisThread),
        part_(file_, picture().part.index) {
    require_same(part_.header(), picture().part);
  }

 private:
  Status decode(const ExrBand& band, RowBand& rows) override {
    const ExrWindow& data = picture().part.data;
    const int first_row = band.row_begin - layout().row_of_chunk(band.chunk_begin);
    const int first_line = data.y_begin + band.row_begin - layout().data_y;
    const Status status = at_border(picture().where(band.row_begin), [&] {
      Imf::FrameBuffer slices;
      for (int c = 0; c < rows.channel_count; ++c) {
        const auto x_stride = static_cast<std::ptrdiff_t>(sample_size(rows.channels[c].type));
        char* base = base_for<char>(rows_.sample(c, first_row), data.x_begin, x_stride, first_line,
                                    rows_.row_stride(c));
        slices.insert(
            picture().part.channels[picture().colour.channels[c]].name,
            Imf::Slice(pixel_type(rows.channels[c].type), base, static_cast<std::size_t>(x_stride),
                       static_cast<std::size_t>(rows_.row_stride(c))));
      }
      part_.setFrameBuffer(slices);
      part_.readPixels(first_line, first_line + band.row_end - band.row_begin - 1);
    });
    SHOAL_RETURN_IF_ERROR(status);
    rows_.show(band, rows);
    return {};
  }

  ExrPlanarRows rows_;
  FileStream stream_;
  Imf::MultiPartInputFile file_;
  Imf::InputPart part_;
};

class LuminanceChromaReader final : public ExrBandReader {
 public:
  explicit LuminanceChromaReader(std::shared_ptr<const ExrPicture> picture_in)
      : ExrBandReader(std::move(picture_in)),
        rows_(picture()),
        stream_(picture().context->file()),
        file_(stream_, picture().layer, kInThisThread) {
    require_same(file_.header(), picture().part);
    pixels_.resize_zeroed(static_cast<std::size_t>(layout().data_width) *
                          static_cast<std::size_t>(layout().rows_per_band()) * sizeof(Imf::Rgba));
  }

 private:
  Status decode(const ExrBand& band, RowBand& rows) override {
    const ExrWindow& data = picture().part.data;
    const int count = band.row_end - band.row_begin;
    const int first_line = data.y_begin + band.row_begin - layout().data_y;
    const Status status = at_border(picture().where(band.row_begin), [&] {
      constexpr auto kPixel = static_cast<std::ptrdiff_t>(sizeof(Imf::Rgba));
      auto* base = base_for<Imf::Rgba>(pixels_.data(), data.x_begin, kPixel, first_line,
                                       kPixel * layout().data_width);
      file_.setFrameBuffer(base, 1, static_cast<std::size_t>(layout().data_width));
      file_.readPixels(first_line, first_line + count - 1);
    });
    SHOAL_RETURN_IF_ERROR(status);
    const int first_row = band.row_begin - layout().row_of_chunk(band.chunk_begin);
    for (int row = 0; row < count; ++row) separate(row, first_row + row);
    rows_.show(band, rows);
    return {};
  }

  // The library hands out interleaved pixels only.
  void separate(int from, int to) {
    const std::size_t width = static_cast<std::size_t>(layout().data_width);
    const std::byte* pixel =
        pixels_.data() + static_cast<std::size_t>(from) * width * sizeof(Imf::Rgba);
    std::byte* r = rows_.sample(0, to);
    std::byte* g = rows_.sample(1, to);
    std::byte* b = rows_.sample(2, to);
    constexpr std::size_t kHalf = sizeof(Imf::Rgba::r);
    for (std::size_t x = 0; x < width; ++x, pixel += sizeof(Imf::Rgba)) {
      std::memcpy(r + x * kHalf, pixel + offsetof(Imf::Rgba, r), kHalf);
      std::memcpy(g + x * kHalf, pixel + offsetof(Imf::Rgba, g), kHalf);
      std::memcpy(b + x * kHalf, pixel + offsetof(Imf::Rgba, b), kHalf);
    }
  }

  ExrPlanarRows rows_;
  FileStream stream_;
  Imf::RgbaInputFile file_;
  AlignedBuffer<std::byte> pixels_;
};

template <typename Reader>
Result<std::unique_ptr<BandReader>> open_reader(std::shared_ptr<const ExrPicture> picture) {
  std::unique_ptr<BandReader> reader;
  SHOAL_RETURN_IF_ERROR(at_border(picture->context->file().path(),
                                  [&] { reader = std::make_unique<Reader>(picture); }));
  return reader;
}

}  // namespace

Result<std::unique_ptr<BandReader>> new_exr_imf_reader(std::shared_ptr<const ExrPicture> picture) {
  return open_reader<ImfReader>(std::move(picture));
}

Result<std::unique_ptr<BandReader>> new_exr_luminance_chroma_reader(
    std::shared_ptr<const ExrPicture> picture) {
  return open_reader<LuminanceChromaReader>(std::move(picture));
}

}  // namespace shoal
