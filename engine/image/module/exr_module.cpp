// OpenEXR's C++ classes, behind the C interface of exr_module.h.
#include "image/module/exr_module.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgba.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

namespace {

using namespace shoal::exr;  // NOLINT: the whole file implements it

constexpr int kInThisThread =
    0;  // the library's thread count: the engine's workers share the cores
constexpr const char* kColours[3] = {"R", "G", "B"};

void say(Message* message, const char* text) {
  std::snprintf(message->text, sizeof message->text, "%s", text);
}

// Exceptions end here.
template <typename Step>
Outcome guarded(Message* message, const Step& step) {
  try {
    step();
    return kOutcomeOk;
  } catch (const std::exception& exception) {
    say(message, exception.what());
  } catch (...) {
    say(message, "an exception of no known kind");
  }
  return kOutcomeFailed;
}

// Reads through the engine's file, with a position of its own.
class InputStream final : public Imf::IStream {
 public:
  explicit InputStream(const Input& input) : Imf::IStream(input.name), input_(input) {}

  bool read(char bytes[], int count) override {
    Message message{};
    const auto size = static_cast<std::size_t>(count);
    if (input_.read(input_.file, position_, bytes, size, &message) != kOutcomeOk) {
      throw std::runtime_error(message.text);
    }
    position_ += size;
    return position_ < input_.size;
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  Input input_;
  std::uint64_t position_ = 0;
};

// OpenEXR writes the rows behind a table of their offsets, and the table at the end.
class OutputStream final : public Imf::OStream {
 public:
  explicit OutputStream(const Output& output) : Imf::OStream(output.name), output_(output) {}

  void write(const char bytes[], int count) override {
    Message message{};
    const auto size = static_cast<std::size_t>(count);
    if (output_.write(output_.file, position_, bytes, size, &message) != kOutcomeOk) {
      throw std::runtime_error(message.text);
    }
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

 private:
  Output output_;
  std::uint64_t position_ = 0;
};

Imf::PixelType pixel_type(SampleKind kind) {
  if (kind == kSampleHalf) return Imf::HALF;
  return kind == kSampleFloat ? Imf::FLOAT : Imf::UINT;
}

std::ptrdiff_t sample_bytes(SampleKind kind) { return kind == kSampleHalf ? 2 : 4; }

// The library finds pixel (x, y) at base + x * x_stride + y * y_stride. This is the base for which
// (x, y) lies at `at`; it is no address of ours, so it is computed as a number.
template <typename T>
T* base_for(T* at, std::int64_t x, std::ptrdiff_t x_stride, std::int64_t y,
            std::ptrdiff_t y_stride) {
  return reinterpret_cast<T*>(reinterpret_cast<std::intptr_t>(at) - x * x_stride - y * y_stride);
}

// The header has been read twice, by different code: what the engine's memory is laid out by must
// be the same.
void require_same(const Imf::Header& header, const Part& part) {
  const Imath::Box2i& window = header.dataWindow();
  bool same = window.min.x == part.x_begin && window.min.y == part.y_begin &&
              window.max.x == part.x_end - 1 && window.max.y == part.y_end - 1;
  for (std::size_t c = 0; c < part.channel_count; ++c) {
    const Channel& channel = part.channels[c];
    const Imf::Channel* found = header.channels().findChannel(channel.name);
    same = same && found && found->type == pixel_type(channel.kind) &&
           found->xSampling == channel.x_sampling && found->ySampling == channel.y_sampling;
  }
  if (!same) throw std::runtime_error("its header contradicts itself");
}

}  // namespace

namespace shoal::exr {

struct Picture {
  virtual ~Picture() = default;
  virtual void read_lines(int begin, int end, const Plane* planes, std::size_t plane_count) = 0;
};

struct Map {
  virtual ~Map() = default;
  virtual void write_rows(const float* const planes[3], std::ptrdiff_t stride, int row_count) = 0;
  virtual void finish() = 0;
};

}  // namespace shoal::exr

namespace {

class PlanesPicture final : public Picture {
 public:
  PlanesPicture(const Part& part, const Input& input)
      : x_begin_(part.x_begin),
        stream_(input),
        file_(stream_, kInThisThread),
        part_(file_, part.index) {
    require_same(part_.header(), part);
  }

  void read_lines(int begin, int end, const Plane* planes, std::size_t plane_count) override {
    Imf::FrameBuffer slices;
    for (std::size_t p = 0; p < plane_count; ++p) {
      const Plane& plane = planes[p];
      const std::ptrdiff_t x_stride = sample_bytes(plane.kind);
      char* base = base_for(plane.sample, x_begin_, x_stride, begin, plane.row_stride);
      slices.insert(plane.channel,
                    Imf::Slice(pixel_type(plane.kind), base, static_cast<std::size_t>(x_stride),
                               static_cast<std::size_t>(plane.row_stride)));
    }
    part_.setFrameBuffer(slices);
    part_.readPixels(begin, end - 1);
  }

 private:
  int x_begin_;
  InputStream stream_;
  Imf::MultiPartInputFile file_;
  Imf::InputPart part_;
};

class LuminanceChromaPicture final : public Picture {
 public:
  LuminanceChromaPicture(const Part& part, const Input& input)
      : x_begin_(part.x_begin),
        width_(static_cast<std::size_t>(std::int64_t{part.x_end} - part.x_begin)),
        stream_(input),
        file_(stream_, part.layer, kInThisThread) {
    require_same(file_.header(), part);
  }

  void read_lines(int begin, int end, const Plane* planes, std::size_t plane_count) override {
    if (plane_count != 3) throw std::logic_error("three planes are wanted");
    pixels_.resize(static_cast<std::size_t>(end - begin) * width_);
    constexpr auto kPixel = static_cast<std::ptrdiff_t>(sizeof(Imf::Rgba));
    auto* base = base_for(pixels_.data(), x_begin_, kPixel, begin,
                          kPixel * static_cast<std::ptrdiff_t>(width_));
    file_.setFrameBuffer(base, 1, width_);
    file_.readPixels(begin, end - 1);
    for (int row = 0; row < end - begin; ++row) separate(row, planes);
  }

 private:
  // The library hands out interleaved pixels only.
  void separate(int row, const Plane* planes) const {
    const Imf::Rgba* pixel = pixels_.data() + static_cast<std::size_t>(row) * width_;
    half* out[3];
    for (int c = 0; c < 3; ++c) {
      out[c] = reinterpret_cast<half*>(planes[c].sample + row * planes[c].row_stride);
    }
    for (std::size_t x = 0; x < width_; ++x, ++pixel) {
      out[0][x] = pixel->r;
      out[1][x] = pixel->g;
      out[2][x] = pixel->b;
    }
  }

  int x_begin_;
  std::size_t width_;
  InputStream stream_;
  Imf::RgbaInputFile file_;
  std::vector<Imf::Rgba> pixels_;
};

void convert(float value, float& sample) { sample = value; }

void convert(float value, half& sample) {
  constexpr float kLargest = 65504.0f;
  sample = half(std::clamp(value, -kLargest, kLargest));  // NaN passes std::clamp unchanged
}

// `Sample` is half or float.
template <typename Sample>
class MapOf final : public Map {
 public:
  MapOf(const MapHeader& map, const Output& output)
      : width_(map.width), row_(static_cast<std::size_t>(width_) * 3), stream_(output) {
    Imf::Header header(map.width, map.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer row;
    for (int c = 0; c < 3; ++c) {
      const auto type = pixel_type(map.kind);
      header.channels().insert(kColours[c], Imf::Channel(type));
      auto* samples = reinterpret_cast<char*>(row_.data() + c * width_);
      row.insert(kColours[c], Imf::Slice(type, samples, sizeof(Sample), 0));
    }
    if (map.environment == kEnvironmentCube) Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    for (std::size_t a = 0; a < map.attribute_count; ++a) {
      header.insert(map.attributes[a].name, Imf::StringAttribute(map.attributes[a].text));
    }
    file_ = std::make_unique<Imf::OutputFile>(stream_, header, kInThisThread);
    file_->setFrameBuffer(row);
  }

  void write_rows(const float* const planes[3], std::ptrdiff_t stride, int row_count) override {
    for (int row = 0; row < row_count; ++row) {
      for (int c = 0; c < 3; ++c) {
        const float* from = planes[c] + row * stride;
        for (int x = 0; x < width_; ++x) convert(from[x], row_[c * width_ + x]);
      }
      file_->writePixels(1);
    }
  }

  void finish() override { file_.reset(); }

 private:
  int width_;
  std::vector<Sample> row_;  // red, green, blue, one behind the other
  OutputStream stream_;
  std::unique_ptr<Imf::OutputFile> file_;
};

Outcome open_picture(PictureKind kind, const Part* part, const Input* input, Picture** picture,
                     Message* message) {
  return guarded(message, [&] {
    if (kind == kPicturePlanes) {
      *picture = new PlanesPicture(*part, *input);
    } else {
      *picture = new LuminanceChromaPicture(*part, *input);
    }
  });
}

Outcome read_lines(Picture* picture, std::int32_t line_begin, std::int32_t line_end,
                   const Plane* planes, std::size_t plane_count, Message* message) {
  return guarded(message, [&] { picture->read_lines(line_begin, line_end, planes, plane_count); });
}

void close_picture(Picture* picture) { delete picture; }

Outcome create_map(const MapHeader* header, const Output* output, Map** map, Message* message) {
  return guarded(message, [&] {
    if (header->kind == kSampleHalf) {
      *map = new MapOf<half>(*header, *output);
    } else {
      *map = new MapOf<float>(*header, *output);
    }
  });
}

Outcome write_rows(Map* map, const float* const planes[3], std::ptrdiff_t stride,
                   std::int32_t row_count, Message* message) {
  return guarded(message, [&] { map->write_rows(planes, stride, row_count); });
}

Outcome finish_map(Map* map, Message* message) {
  return guarded(message, [&] { map->finish(); });
}

void close_map(Map* map) { delete map; }

constexpr Module kModule = {kInterfaceVersion, open_picture, read_lines, close_picture,
                            create_map,        write_rows,   finish_map, close_map};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* shoal_exr_module() {
  return &kModule;
}
