// OpenEXR maps. Pixels are at their centres, so the envmap attribute (whose border pixels lie on
// the poles) is not set.
#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <exception>
#include <span>
#include <type_traits>

#include "image/map_formats.h"

namespace shoal {
namespace {

constexpr const char* kChannelNames[3] = {"R", "G", "B"};

// OpenEXR writes the rows behind a table of their offsets, and the table at the end. A failure is
// kept, because OpenEXR's destructor swallows it.
class AtomicStream final : public Imf::OStream {
 public:
  AtomicStream(AtomicFile file, const std::string& name)
      : Imf::OStream(name.c_str()), file_(std::move(file)) {}

  void write(const char bytes[], int count) override {
    const auto span = std::as_bytes(std::span(bytes, static_cast<std::size_t>(count)));
    const auto within = std::min<std::uint64_t>(span.size(), size_ - position_);
    if (status_ && within > 0) status_ = file_.write_at(position_, span.first(within));
    if (status_ && within < span.size()) status_ = file_.write(span.subspan(within));
    if (!status_) throw Iex::IoExc(status_.error().what);
    position_ += span.size();
    size_ = std::max(size_, position_);
  }

  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  Status commit() { return status_ ? file_.commit() : status_; }
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  AtomicFile file_;
  std::uint64_t position_ = 0;
  std::uint64_t size_ = 0;
  Status status_;
};

template <typename Sample>
Imf::Header make_header(const MapFile& map) {
  Imf::Header header(map.width, map.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  const auto type = std::is_same_v<Sample, half> ? Imf::HALF : Imf::FLOAT;
  for (const char* name : kChannelNames) header.channels().insert(name, Imf::Channel(type));
  for (const auto& [name, text] : map.attributes) {
    header.insert(name.c_str(), Imf::StringAttribute(text));
  }
  return header;
}

void convert(float value, float& sample) { sample = value; }

void convert(float value, half& sample) {
  constexpr float kLargest = 65504.0f;
  sample = half(std::clamp(value, -kLargest, kLargest));  // NaN passes std::clamp unchanged
}

// `Sample` is half or float.
template <typename Sample>
class ExrMapWriter final : public MapWriter {
 public:
  ExrMapWriter(const std::filesystem::path& path, const MapFile& map, AtomicFile file)
      : MapWriter(path, map), stream_(std::move(file), path.string()) {}

  Status open(const MapFile& map) {
    row_.resize(static_cast<std::size_t>(width_) * 3);
    return guarded([&] {
      const auto header = make_header<Sample>(map);
      Imf::FrameBuffer row;
      for (int c = 0; c < 3; ++c) {
        auto* samples = reinterpret_cast<char*>(row_.data() + c * width_);
        const auto type = header.channels()[kChannelNames[c]].type;
        row.insert(kChannelNames[c], Imf::Slice(type, samples, sizeof(Sample), 0));
      }
      constexpr int kNoThreads = 0;  // the callers' own workers share the cores
      file_ = std::make_unique<Imf::OutputFile>(stream_, header, kNoThreads);
      file_->setFrameBuffer(row);
    });
  }

 private:
  Status encode_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                     int row_count) override {
    return guarded([&] {
      for (int row = 0; row < row_count; ++row) {
        for (int c = 0; c < 3; ++c) {
          const float* from = planes[c] + row * stride;
          for (int x = 0; x < width_; ++x) convert(from[x], row_[c * width_ + x]);
        }
        file_->writePixels(1);
      }
    });
  }

  Status finish() override {
    SHOAL_RETURN_IF_ERROR(guarded([&] { file_.reset(); }));
    return stream_.commit();
  }

  // Exceptions of OpenEXR end here.
  template <typename Step>
  Status guarded(Step step) {
    try {
      step();
      return {};
    } catch (const std::exception& exception) {
      return stream_.status() ? Status(write_error(exception.what())) : stream_.status();
    }
  }

  AtomicStream stream_;
  std::vector<Sample> row_;  // red, green, blue, one behind the other
  std::unique_ptr<Imf::OutputFile> file_;
};

template <typename Sample>
MapWriterResult create(const std::filesystem::path& path, const MapFile& map) {
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  auto writer = std::make_unique<ExrMapWriter<Sample>>(path, map, std::move(file));
  SHOAL_RETURN_IF_ERROR(writer->open(map));
  return std::unique_ptr<MapWriter>(std::move(writer));
}

}  // namespace

MapWriterResult create_exr_map(const std::filesystem::path& path, const MapFile& map) {
  return map.format == MapFormat::exr_half ? create<half>(path, map) : create<float>(path, map);
}

}  // namespace shoal
