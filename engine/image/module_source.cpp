#include "image/module_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/aligned_buffer.h"
#include "core/input_file.h"
#include "image/module/oiio_module.h"
#include "image/module_loader.h"

namespace shoal {
namespace {

constexpr std::int64_t kBandBytes = std::int64_t{1} << 20;     // all planes, if not asked
constexpr std::int64_t kMaxBandBytes = std::int64_t{1} << 26;  // whatever is asked, but for tiles
constexpr std::int64_t kMaxTileRowBytes = std::int64_t{1} << 28;

Result<const oiio::Module*> the_module() {
  static LazyModule module({oiio::kModuleFile, oiio::kEntryPoint, oiio::kInterfaceVersion,
                            "EXR and Radiance .hdr are read without it; for other formats build "
                            "shoal with OpenImageIO, or set SHOAL_MODULE_PATH to the folder of the "
                            "module"});
  SHOAL_ASSIGN_OR_RETURN(loaded, module.get());
  return static_cast<const oiio::Module*>(loaded);
}

struct ClosePicture {
  const oiio::Module* module;
  void operator()(oiio::Picture* picture) const { module->close(picture); }
};
using PictureHandle = std::unique_ptr<oiio::Picture, ClosePicture>;

ErrorCode error_code(oiio::Outcome outcome) {
  return outcome == oiio::kOutcomeUnsupported ? ErrorCode::unsupported : ErrorCode::malformed;
}

// OpenImageIO's messages may have several lines.
std::string one_line(const char* text) {
  std::string line(text);
  while (line.ends_with('\n')) line.pop_back();
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

// What is needed to open the same file again, as each reader does.
struct ModuleFile {
  const oiio::Module* module = nullptr;
  std::string path;
  oiio::IntegerEncoding encoding = oiio::kIntegerSrgb;
  oiio::Facts facts{};
  int rows_per_band = 0;

  Result<PictureHandle> open(oiio::Facts& opened) const {
    oiio::Picture* picture = nullptr;
    oiio::Message message{};
    const auto outcome = module->open(path.c_str(), encoding, &picture, &opened, &message);
    if (outcome == oiio::kOutcomeOk) return PictureHandle(picture, ClosePicture{module});
    return Error{error_code(outcome), "OpenImageIO says: " + one_line(message.text), path,
                 outcome == oiio::kOutcomeUnsupported ? "convert the picture to EXR"
                                                      : "copy or write the file again"};
  }
};

class ModuleReader final : public BandReader {
 public:
  ModuleReader(std::shared_ptr<const ModuleFile> file, PictureHandle picture)
      : file_(std::move(file)), picture_(std::move(picture)) {}

  Result<RowBand> read(int index) override {
    const auto& facts = file_->facts;
    if (rows_read_ >= facts.height || index != rows_read_ / file_->rows_per_band) {
      return Error{ErrorCode::internal, fmt::format("band {} was asked for out of order", index),
                   file_->path, ""};
    }
    const int begin = rows_read_;
    const int end = std::min(begin + file_->rows_per_band, facts.height);
    const auto pixels = static_cast<std::size_t>(end - begin) * facts.width;
    planes_.resize_uninitialised(pixels * facts.channel_count);
    oiio::Message message{};
    const auto outcome =
        file_->module->read_rows(picture_.get(), begin, end, planes_.data(), &message);
    if (outcome != oiio::kOutcomeOk) {
      return Error{error_code(outcome),
                   fmt::format("rows {} to {} cannot be read; {} of {} are good. OpenImageIO says: "
                               "{}",
                               begin, end - 1, begin, facts.height, one_line(message.text)),
                   fmt::format("{}:{}", file_->path, begin), "copy or write the file again"};
    }
    rows_read_ = end;
    return band(begin, end, pixels);
  }

 private:
  [[nodiscard]] RowBand band(int begin, int end, std::size_t pixels) const {
    RowBand band;
    band.row_begin = begin;
    band.row_end = end;
    band.width = file_->facts.width;
    band.channel_count = file_->facts.channel_count;
    for (int c = 0; c < band.channel_count; ++c) {
      band.channels[c] = {reinterpret_cast<const std::byte*>(planes_.data() + c * pixels),
                          static_cast<std::ptrdiff_t>(sizeof(float)) * band.width,
                          SampleType::float32};
    }
    return band;
  }

  std::shared_ptr<const ModuleFile> file_;
  PictureHandle picture_;
  AlignedBuffer<float> planes_;
  int rows_read_ = 0;
};

Status check_size(const oiio::Facts& facts, const std::string& path) {
  const auto pixels = std::int64_t{facts.width} * facts.height;
  const auto quantum_bytes = std::int64_t{facts.row_quantum} * facts.width * 3 * 4;
  const bool sane = facts.width > 0 && facts.height > 0 && facts.row_quantum > 0 &&
                    facts.width <= kMaxSide && facts.height <= kMaxSide && pixels <= kMaxPixels &&
                    quantum_bytes <= kMaxTileRowBytes;
  if (sane) return {};
  return Error{ErrorCode::unsupported,
               fmt::format("declares {} x {} pixels in rows of {}; that is too large", facts.width,
                           facts.height, facts.row_quantum),
               path, "check whether the header is damaged"};
}

int choose_rows_per_band(const oiio::Facts& facts, int wish) {
  const std::int64_t row_bytes = std::int64_t{facts.width} * facts.channel_count * 4;
  const std::int64_t most = std::max<std::int64_t>(kMaxBandBytes / row_bytes, 1);
  const std::int64_t wanted = wish > 0 ? std::min<std::int64_t>(wish, most)
                                       : std::max<std::int64_t>(kBandBytes / row_bytes, 1);
  const std::int64_t quantum = facts.row_quantum;
  return static_cast<int>((std::min<std::int64_t>(wanted, facts.height) + quantum - 1) / quantum *
                          quantum);
}

std::vector<std::string> warnings_for(const oiio::Facts& facts, Encoding encoding) {
  std::vector<std::string> warnings;
  if (facts.orientation != 1) {
    warnings.push_back(fmt::format(
        "the file asks to be shown turned or mirrored (orientation {}); it is taken as stored",
        facts.orientation));
  }
  if (facts.is_cropped && !facts.is_cube) {
    warnings.emplace_back(
        "the stored pixels are not the whole frame; they are taken as the picture");
  }
  const std::string_view space = facts.colour_space;
  const bool taken_as_srgb = facts.is_integer && encoding == Encoding::srgb;
  if (taken_as_srgb && !space.empty() && space != "sRGB") {
    warnings.push_back(fmt::format(
        "the file says that its values are \"{}\"; they are taken as sRGB (encoding: linear takes "
        "them as linear)",
        space));
  }
  return warnings;
}

class ModuleSource final : public PanoramaSource {
 public:
  ModuleSource(std::shared_ptr<const ModuleFile> file, Encoding encoding) : file_(std::move(file)) {
    const auto& facts = file_->facts;
    info_.format = facts.format;
    info_.width = facts.width;
    info_.height = facts.height;
    info_.channel_count = facts.channel_count;
    info_.rows_per_band = file_->rows_per_band;
    info_.band_count = (facts.height - 1) / file_->rows_per_band + 1;
    info_.band_access = BandAccess::sequential;
    if (facts.is_cube) info_.environment = EnvironmentMap::cube_strip;
    info_.warnings = warnings_for(facts, encoding);
  }

  [[nodiscard]] const PictureInfo& info() const override { return info_; }

  // Each reader opens the file for itself: an ImageInput is a cursor, and not to be shared.
  [[nodiscard]] Result<std::unique_ptr<BandReader>> new_reader() const override {
    oiio::Facts facts{};
    SHOAL_ASSIGN_OR_RETURN(picture, file_->open(facts));
    if (facts.width != file_->facts.width || facts.height != file_->facts.height ||
        facts.channel_count != file_->facts.channel_count) {
      return Error{ErrorCode::unreadable, "was changed while it was read", file_->path,
                   "run again when the file is complete"};
    }
    return std::unique_ptr<BandReader>(std::make_unique<ModuleReader>(file_, std::move(picture)));
  }

 private:
  std::shared_ptr<const ModuleFile> file_;
  PictureInfo info_;
};

}  // namespace

Result<std::unique_ptr<PanoramaSource>> open_with_module(const std::filesystem::path& path,
                                                         const ReadOptions& options) {
  // Tells what the system has against the file in the same words as the other readers.
  SHOAL_RETURN_IF_ERROR(InputFile::open(path));
  auto loaded = the_module();
  if (!loaded) {
    loaded.error().where = path.string();
    return std::move(loaded).error();
  }
  auto file = std::make_shared<ModuleFile>();
  file->module = *loaded;
  file->path = path.string();
  file->encoding = options.encoding == Encoding::srgb ? oiio::kIntegerSrgb : oiio::kIntegerLinear;
  SHOAL_RETURN_IF_ERROR(file->open(file->facts));
  SHOAL_RETURN_IF_ERROR(check_size(file->facts, file->path));
  file->rows_per_band = choose_rows_per_band(file->facts, options.rows_per_band);
  return std::unique_ptr<PanoramaSource>(
      std::make_unique<ModuleSource>(std::move(file), options.encoding));
}

}  // namespace shoal
