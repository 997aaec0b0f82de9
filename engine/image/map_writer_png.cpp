// PNG previews: 8-bit sRGB, tone-mapped, with the exposure as a text chunk.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <span>

#include "image/map_formats.h"
#include "image/srgb.h"

namespace shoal {
namespace {

class PngMapWriter final : public MapWriter {
 public:
  PngMapWriter(const std::filesystem::path& path, const MapFile& map, AtomicFile file)
      : MapWriter(path, map), exposure_(map.preview_exposure), file_(std::move(file)) {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_) info_ = png_create_info_struct(png_);
    row_.resize(static_cast<std::size_t>(width_) * 3);
  }
  ~PngMapWriter() override { png_destroy_write_struct(&png_, &info_); }
  PngMapWriter(const PngMapWriter&) = delete;
  PngMapWriter& operator=(const PngMapWriter&) = delete;

  Status write_header(const MapFile& map) {
    if (!info_) return write_error("libpng found no memory");
    auto attributes = map.attributes;
    attributes.emplace_back("Exposure",
                            fmt::format("{} stops; curve 1 - exp(-v * 2^stops)", exposure_));
    std::vector<png_text> texts;
    for (auto& [name, text] : attributes) {
      png_text chunk{};
      chunk.compression = PNG_ITXT_COMPRESSION_NONE;  // UTF-8
      chunk.key = name.data();
      chunk.text = text.data();
      chunk.itxt_length = text.size();
      texts.push_back(chunk);
    }
    return guarded([&] {
      png_set_write_fn(png_, this, on_write, on_flush);
      png_set_IHDR(png_, info_, static_cast<png_uint_32>(width_), static_cast<png_uint_32>(height_),
                   8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                   PNG_FILTER_TYPE_DEFAULT);
      png_set_sRGB(png_, info_, PNG_sRGB_INTENT_RELATIVE);
      png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
      png_write_info(png_, info_);
    });
  }

 private:
  Status encode_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                     int row_count) override {
    for (int row = 0; row < row_count; ++row) {
      for (int c = 0; c < 3; ++c) {
        const float* from = planes[c] + row * stride;
        for (int x = 0; x < width_; ++x) row_[3 * x + c] = preview_sample(from[x], exposure_);
      }
      SHOAL_RETURN_IF_ERROR(guarded([&] { png_write_row(png_, row_.data()); }));
    }
    return {};
  }

  Status finish() override {
    SHOAL_RETURN_IF_ERROR(guarded([&] { png_write_end(png_, nullptr); }));
    return file_.commit();
  }

  // libpng reports by longjmp. Nothing between here and there has a destructor that would be
  // missed: a step only calls libpng, and on_write() is done with its own objects before it calls
  // back.
  template <typename Step>
  Status guarded(const Step& step) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return write_status_ ? Status(write_error(message_)) : write_status_;
    }
    step();
    return {};
  }

  static void on_write(png_structp png, png_bytep bytes, std::size_t count) {
    auto* self = static_cast<PngMapWriter*>(png_get_io_ptr(png));
    self->write_status_ = self->file_.write(std::as_bytes(std::span(bytes, count)));
    if (!self->write_status_) png_error(png, "");
  }
  static void on_flush(png_structp) {}
  static void on_warning(png_structp, png_const_charp) {}

  [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
    auto* self = static_cast<PngMapWriter*>(png_get_error_ptr(png));
    std::snprintf(self->message_, sizeof self->message_, "%s", text);
    png_longjmp(png, 1);
  }

  double exposure_;
  AtomicFile file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<unsigned char> row_;
  Status write_status_;
  char message_[128] = "";
};

}  // namespace

unsigned char preview_sample(float value, double exposure) {
  const double light = value > 0.0f ? std::exp2(exposure) * static_cast<double>(value) : 0.0;
  return static_cast<unsigned char>(std::lround(255.0 * linear_to_srgb(-std::expm1(-light))));
}

MapWriterResult create_png_map(const std::filesystem::path& path, const MapFile& map) {
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  auto writer = std::make_unique<PngMapWriter>(path, map, std::move(file));
  SHOAL_RETURN_IF_ERROR(writer->write_header(map));
  return std::unique_ptr<MapWriter>(std::move(writer));
}

}  // namespace shoal
