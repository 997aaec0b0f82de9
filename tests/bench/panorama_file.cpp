#include "bench/panorama_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <half.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bench/panorama_painter.h"
#include "image/map_writer.h"

namespace shoal::bench {
namespace {

constexpr int kRowsAtOnce = 64;

constexpr std::array<std::pair<std::string_view, Imf::Compression>, 10> kCompressions = {{
    {"none", Imf::NO_COMPRESSION},
    {"rle", Imf::RLE_COMPRESSION},
    {"zips", Imf::ZIPS_COMPRESSION},
    {"zip", Imf::ZIP_COMPRESSION},
    {"piz", Imf::PIZ_COMPRESSION},
    {"pxr24", Imf::PXR24_COMPRESSION},
    {"b44", Imf::B44_COMPRESSION},
    {"b44a", Imf::B44A_COMPRESSION},
    {"dwaa", Imf::DWAA_COMPRESSION},
    {"dwab", Imf::DWAB_COMPRESSION},
}};

constexpr std::array<std::pair<std::string_view, Imf::PixelType>, 2> kPixelTypes = {{
    {"half", Imf::HALF},
    {"float", Imf::FLOAT},
}};

class RadianceFile final : public PanoramaFile {
 public:
  RadianceFile(std::unique_ptr<MapWriter> writer, int width)
      : writer_(std::move(writer)), width_(width) {}

  Status write_rows(const std::array<const float*, 3>& planes, int row_count) override {
    return writer_->write_rows(planes, width_, row_count);
  }
  Status commit() override { return writer_->commit(); }

 private:
  std::unique_ptr<MapWriter> writer_;
  int width_;
};

class ExrFile final : public PanoramaFile {
 public:
  ExrFile(std::filesystem::path path, const Imf::Header& header, Imf::PixelType type)
      : path_(std::move(path)), type_(type), file_(std::in_place, part().c_str(), header) {
    width_ = header.dataWindow().max.x + 1;
  }
  ~ExrFile() override {
    file_.reset();
    std::error_code ignored;
    std::filesystem::remove(part(), ignored);
  }

  Status write_rows(const std::array<const float*, 3>& planes, int row_count) override {
    const std::size_t plane_samples = static_cast<std::size_t>(width_) * row_count;
    if (type_ == Imf::HALF) {
      halves_.resize(3 * plane_samples);
      for (int c = 0; c < 3; ++c) {
        std::copy_n(planes[c], plane_samples, halves_.begin() + c * plane_samples);
      }
    }
    Imf::FrameBuffer frame;
    for (int c = 0; c < 3; ++c) {
      const void* plane = planes[c];
      if (type_ == Imf::HALF) plane = halves_.data() + c * plane_samples;
      frame.insert(kNames[c], slice_at(plane));
    }
    try {
      file_->setFrameBuffer(frame);
      file_->writePixels(row_count);
    } catch (const std::exception& exception) {
      return Error{ErrorCode::write_failed, exception.what(), path_.string(), ""};
    }
    rows_written_ += row_count;
    return {};
  }

  Status commit() override {
    file_.reset();
    std::error_code failed;
    std::filesystem::rename(part(), path_, failed);
    if (failed) return Error{ErrorCode::write_failed, failed.message(), path_.string(), ""};
    return {};
  }

 private:
  static constexpr std::array<const char*, 3> kNames = {"R", "G", "B"};

  [[nodiscard]] std::string part() const { return path_.string() + ".part"; }

  // The library counts rows from the top of the picture, so the base lies before the plane.
  [[nodiscard]] Imf::Slice slice_at(const void* plane) const {
    const std::size_t sample = type_ == Imf::HALF ? sizeof(half) : sizeof(float);
    const std::size_t row = sample * static_cast<std::size_t>(width_);
    const auto base = reinterpret_cast<std::uintptr_t>(plane) - row * rows_written_;
    return {type_, reinterpret_cast<char*>(base), sample, row};
  }

  std::filesystem::path path_;
  Imf::PixelType type_;
  std::optional<Imf::OutputFile> file_;
  int width_ = 0;
  int rows_written_ = 0;
  std::vector<half> halves_;
};

Result<std::unique_ptr<PanoramaFile>> create_hdr(const std::filesystem::path& path, int width,
                                                 int height) {
  MapFile map;
  map.format = MapFormat::hdr;
  map.width = width;
  map.height = height;
  SHOAL_ASSIGN_OR_RETURN(writer, MapWriter::create(path, map));
  return std::unique_ptr<PanoramaFile>(std::make_unique<RadianceFile>(std::move(writer), width));
}

Result<std::unique_ptr<PanoramaFile>> create_exr(const std::filesystem::path& path, int width,
                                                 int height, Imf::Compression compression,
                                                 Imf::PixelType type) {
  Imf::Header header(width, height);
  header.compression() = compression;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(type));
  try {
    return std::unique_ptr<PanoramaFile>(std::make_unique<ExrFile>(path, header, type));
  } catch (const std::exception& exception) {
    return Error{ErrorCode::write_failed, exception.what(), path.string(), ""};
  }
}

}  // namespace

std::vector<std::string> panorama_file_kinds() {
  std::vector<std::string> kinds = {"hdr"};
  for (const auto& [type_name, type] : kPixelTypes) {
    for (const auto& [name, compression] : kCompressions) {
      kinds.push_back(std::string(type_name) + "-" + std::string(name));
    }
  }
  return kinds;
}

Result<std::unique_ptr<PanoramaFile>> PanoramaFile::create(std::string_view kind,
                                                           const std::filesystem::path& path,
                                                           int width, int height) {
  if (kind == "hdr") return create_hdr(path, width, height);
  for (const auto& [type_name, type] : kPixelTypes) {
    for (const auto& [name, compression] : kCompressions) {
      if (kind == std::string(type_name) + "-" + std::string(name)) {
        return create_exr(path, width, height, compression, type);
      }
    }
  }
  return Error{ErrorCode::usage, "there is no kind of file \"" + std::string(kind) + "\"", "",
               "hdr, half-C or float-C with a compression C of OpenEXR"};
}

Status make_panorama_files(int width, int height, std::uint64_t seed,
                           const std::vector<PanoramaFileRequest>& requests) {
  std::vector<std::unique_ptr<PanoramaFile>> files;
  for (const auto& [kind, path] : requests) {
    SHOAL_ASSIGN_OR_RETURN(file, PanoramaFile::create(kind, path, width, height));
    files.push_back(std::move(file));
  }
  PanoramaPainter painter(width, height, seed);
  const auto plane_samples = static_cast<std::size_t>(width) * kRowsAtOnce;
  std::vector<float> samples(3 * plane_samples);
  const std::array<float*, 3> planes = {samples.data(), samples.data() + plane_samples,
                                        samples.data() + 2 * plane_samples};
  for (int begin = 0; begin < height; begin += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, height - begin);
    for (int row = 0; row < count; ++row) {
      const auto offset = static_cast<std::ptrdiff_t>(row) * width;
      painter.paint_row(begin + row, {planes[0] + offset, planes[1] + offset, planes[2] + offset});
    }
    for (auto& file : files) {
      SHOAL_RETURN_IF_ERROR(file->write_rows({planes[0], planes[1], planes[2]}, count));
    }
  }
  for (auto& file : files) SHOAL_RETURN_IF_ERROR(file->commit());
  return {};
}

}  // namespace shoal::bench
