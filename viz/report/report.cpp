#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/atomic_file.h"
#include "library/light.h"
#include "output/coefficient_table.h"
#include "report/figures.h"
#include "report/page.h"
#include "report/page_data.h"
#include "report/picture.h"
#include "report/script_text.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

constexpr int kTableWidth = 128;             // of the table's thumbnails, shown at 68
constexpr std::size_t kPicturesAtOnce = 32;  // previews made by one run of `shoal preview`
constexpr std::string_view kPageMark = "<meta name=\"generator\" content=\"shoal report\">";
constexpr std::string_view kPanoramaMark = "shoalPanorama(";

// The first bytes of a file, as many as tell whether it is ours; empty where it cannot be read.
std::string beginning_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(1024, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

Status check_folder(const fs::path& folder) {
  const fs::path page = folder / "index.html";
  std::error_code ignored;
  if (!fs::exists(page, ignored) || beginning_of(page).find(kPageMark) != std::string::npos) {
    return {};
  }
  return Error{ErrorCode::usage, "there is a page already that no report wrote", page.string(),
               "choose another folder, or move that page away"};
}

// Whether a report wrote this file: six digits, its extension, and its maker's mark.
bool is_ours(const fs::path& path, std::string_view extension, std::string_view mark) {
  const std::string stem = path.stem().string();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return path.extension() == extension && stem.size() >= 6 &&
         std::all_of(stem.begin(), stem.end(), is_digit) &&
         beginning_of(path).find(mark) != std::string::npos;
}

// Removes what an earlier report has left in a folder, but `kept`; and the folder where it is empty
// then. What cannot be removed harms no one.
void remove_stale(const fs::path& folder, const std::set<fs::path>& kept,
                  std::string_view extension, std::string_view mark) {
  std::error_code ignored;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const bool plain = entry.symlink_status(ignored).type() == fs::file_type::regular;
    if (plain && !kept.contains(entry.path()) && is_ours(entry.path(), extension, mark)) {
      stale.push_back(entry.path());
    }
  }
  for (const fs::path& path : stale) fs::remove(path, ignored);
  if (!stale.empty() && fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

// A page may go to other machines, and these need not know how this one's folders are called.
std::string without_folder(std::string text, const fs::path& file) {
  if (!file.is_absolute() || file.parent_path() == file.root_path()) return text;
  const std::string folder = (file.parent_path() / "").string();
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) {
    text.erase(at, folder.size());
  }
  return text;
}

// What all names that are absolute paths begin with, as those of files called alike do.
std::string folder_of_names(const Library& library) {
  std::optional<fs::path> common;
  const auto take = [&](const fs::path& name) {
    if (!name.is_absolute()) return;
    const fs::path folder = name.parent_path();
    if (!common) common = folder;
    const auto end = std::ranges::mismatch(*common, folder).in1;
    fs::path shared;
    for (auto part = common->begin(); part != end; ++part) shared /= *part;
    common = shared;
  };
  for (const Panorama& panorama : library.panoramas) take(panorama.name);
  for (const FailedPanorama& failed : library.failed) take(failed.name);
  return common ? (*common / "").string() : "";
}

// The light's own, but where the pixels could not be made those of it.
double exposure_of_pixels(const Panorama& panorama, double of_light) {
  if (panorama.change.is_whole || !panorama.pixels) return of_light;
  const auto& [r, g, b] = panorama.pixels->mean;
  const glm::dvec3 mean(r, g, b);
  return luminance(mean) > 0.0 ? exposure_of_mean(mean) : of_light;
}

// One report while it is written.
class ReportWriter {
 public:
  ReportWriter(const Library& library, const PictureSource& pictures,
               const ReportSettings& settings)
      : library_(library),
        pictures_(pictures),
        settings_(settings),
        names_begin_(folder_of_names(library)) {
    for (const FailedPanorama& failed : library.failed) {
      failed_.push_back({shown_name(failed.name), without_folder(failed.error, failed.file)});
    }
    for (std::size_t i = 0; i < library.panoramas.size(); ++i) {
      const Panorama& panorama = library.panoramas[i];
      if (all_finite(panorama.coefficients)) {
        shown_.push_back(i);
      } else {
        failed_.push_back({shown_name(panorama.name), "its coefficients are not all finite"});
      }
    }
  }

  Status write(const ReportProgress& progress) {
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      if (i % kPicturesAtOnce == 0) {
        const auto batch = std::span(shown_).subspan(i);
        pictures_.prepare(batch.first(std::min(kPicturesAtOnce, batch.size())),
                          settings_.thumbnail_width);
      }
      SHOAL_RETURN_IF_ERROR(add(shown_[i]));
      if (progress) progress(i + 1, shown_.size());
    }
    SHOAL_RETURN_IF_ERROR(write_page());
    remove_stale(settings_.folder / "panoramas", written_, ".js", kPanoramaMark);
    remove_stale(settings_.folder / "thumbnails", written_, ".png", kPngSoftware);
    return {};
  }

 private:
  [[nodiscard]] std::string shown_name(const std::string& name) const {
    return name.starts_with(names_begin_) ? name.substr(names_begin_.size()) : name;
  }

  Status add(std::size_t index) {
    const Panorama& panorama = library_.panoramas[index];
    const Coefficients radiance = radiance_of(panorama);
    const Pixels& pixels = pictures_.get(index, settings_.thumbnail_width);
    std::string note;
    if (pixels.empty()) note = without_folder(pictures_.why_empty(index), panorama.file);
    IndexEntry entry;
    entry.panorama = &panorama;
    entry.name = shown_name(panorama.name);
    entry.frame = settings_.frame.value_or(panorama.frame);
    entry.figures = light_figures(panorama);
    entry.exposure = automatic_exposure(radiance);
    entry.ball = irradiance_ball(radiance);
    for (const std::string& warning : panorama.warnings) {
      entry.warnings.push_back(without_folder(warning, panorama.file));
    }
    std::string data = panorama_data(panorama, entry.frame, pixels, note);
    std::string thumbnail;
    if (!pixels.empty()) {
      thumbnail =
          srgb_png(shrunk(pixels, kTableWidth), exposure_of_pixels(panorama, entry.exposure));
    }
    if (shown_.size() == 1) {
      inlined_ = std::move(data);
      if (!thumbnail.empty()) entry.thumbnail = "data:image/png;base64," + base64(thumbnail);
    } else {
      SHOAL_RETURN_IF_ERROR(write_beside(data, thumbnail, entry));
    }
    entries_.push_back(std::move(entry));
    return {};
  }

  Status write_beside(const std::string& data, const std::string& thumbnail, IndexEntry& entry) {
    const std::string number = fmt::format("{:06}", entries_.size());
    SHOAL_RETURN_IF_ERROR(
        write_file("panoramas/" + number + ".js",
                   fmt::format("{}{},{});\n", kPanoramaMark, entries_.size(), data)));
    if (thumbnail.empty()) return {};
    entry.thumbnail = "thumbnails/" + number + ".png";
    return write_file(entry.thumbnail, thumbnail);
  }

  Status write_page() {
    const std::string_view page = page_template();
    constexpr std::string_view kTitle = "@TITLE@";
    constexpr std::string_view kData = "@DATA@";
    const std::size_t title = page.find(kTitle);
    const std::size_t data = page.find(kData);
    std::string text(page.substr(0, title));
    text += html_escaped(library_.title);
    text += page.substr(title + kTitle.size(), data - title - kTitle.size());
    text += index_data(library_, entries_, failed_, inlined_);
    text += page.substr(data + kData.size());
    return write_file("index.html", text);
  }

  Status write_file(const std::string& name, const std::string& content) {
    const fs::path path = settings_.folder / name;
    written_.insert(path);
    return write_file_atomically(path, content);
  }

  const Library& library_;
  const PictureSource& pictures_;
  const ReportSettings& settings_;
  const std::string names_begin_;
  std::vector<std::size_t> shown_;  // panoramas of the library, in its order
  std::vector<FailedPanorama> failed_;
  std::vector<IndexEntry> entries_;  // of shown_
  std::string inlined_;
  std::set<fs::path> written_;
};

}  // namespace

Status write_report(const Library& library, const PictureSource& pictures,
                    const ReportSettings& settings, const ReportProgress& progress) {
  if (settings.thumbnail_width < 2) {
    return Error{ErrorCode::usage,
                 fmt::format("a thumbnail of width {} shows nothing", settings.thumbnail_width), "",
                 "512 is a good width"};
  }
  SHOAL_RETURN_IF_ERROR(check_folder(settings.folder));
  return ReportWriter(library, pictures, settings).write(progress);
}

Status write_report(const Library& library, PixelCache& pixels, const ReportSettings& settings,
                    const ReportProgress& progress) {
  const PictureSource pictures{
      [&](std::span<const std::size_t> panoramas, int width) { pixels.prepare(panoramas, width); },
      [&](std::size_t panorama, int width) -> const Pixels& { return pixels.get(panorama, width); },
      [&](std::size_t panorama) { return pixels.why_empty(panorama); }};
  return write_report(library, pictures, settings, progress);
}

}  // namespace shoal::viz
