#include "library/library.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "library/panorama_files.h"
#include "library/store_library.h"
#include "library/table_library.h"

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSqliteMark = "SQLite format 3";  // every database begins with it

Error nothing_there(const fs::path& source) {
  return Error{ErrorCode::not_found, "there is no such file or folder", source.string(),
               "run `shoal run MANIFEST` first, and name its output folder, or name panoramas"};
}

Error nothing_in(const fs::path& folder) {
  return Error{ErrorCode::not_found, "holds neither a store nor a table nor panoramas",
               folder.string(), "run `shoal run MANIFEST` first, and name its output folder"};
}

Error no_library(const fs::path& manifest) {
  return Error{ErrorCode::usage, "is a manifest, not what a run made of it", manifest.string(),
               "`shoal run` it, and name its output folder"};
}

bool is_database(const fs::path& file) {
  std::array<char, kSqliteMark.size()> bytes{};
  std::ifstream(file, std::ios::binary).read(bytes.data(), bytes.size());
  return std::string_view(bytes.data(), bytes.size()) == kSqliteMark;
}

bool is_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

void append(Library more, Library& library) {
  std::ranges::move(more.panoramas, std::back_inserter(library.panoramas));
  std::ranges::move(more.failed, std::back_inserter(library.failed));
}

// What the store or the JSON table beside a run's CSV table tells; nothing where there is none that
// can be read.
std::vector<Panorama> told_beside(const fs::path& csv) {
  if (csv.filename() != kCsvTableName) return {};
  const fs::path store = csv.parent_path() / kStoreName;
  if (is_there(store)) {
    auto library = load_store(store);
    return library ? std::move(library->panoramas) : std::vector<Panorama>();
  }
  auto records = read_table(csv.parent_path() / kJsonTableName);
  return records ? panoramas_of(std::move(*records)) : std::vector<Panorama>();
}

// Gives the records of a CSV table, which does not tell them, their frames. Returns whether all of
// these are told beside it.
bool take_frames(const fs::path& csv, const Frame& otherwise,
                 std::vector<CoefficientRecord>& records) {
  std::map<std::pair<std::string, std::string>, Frame> frames;
  for (const Panorama& panorama : told_beside(csv)) {
    frames[{panorama.name, variant_of(panorama)}] = panorama.frame;
  }
  bool are_told = true;
  for (CoefficientRecord& record : records) {
    const std::string variant =
        record.variant.empty() ? std::string(kPlainVariant) : record.variant;
    const auto frame = frames.find({record.panorama, variant});
    record.frame = frame != frames.end() ? frame->second : otherwise;
    are_told &= frame != frames.end();
  }
  return are_told;
}

// Sources one after another; panorama files that follow one another are projected together.
class Loader {
 public:
  explicit Loader(const LoadSettings& settings) : settings_(settings) {}

  Status add(const fs::path& source) {
    std::error_code code;
    if (!fs::exists(source, code)) return nothing_there(source);
    if (fs::is_directory(source, code)) return add_folder(source);
    if (is_database(source)) return add_store(source);
    const auto extension = source.extension();
    if (extension == ".yaml" || extension == ".yml") return no_library(source);
    if (extension == ".csv" || extension == ".json" || extension == ".npy") {
      return add_table(source);
    }
    pending_.push_back(source);
    return {};
  }

  Result<Library> finish() {
    SHOAL_RETURN_IF_ERROR(project_pending());
    return std::move(library_);
  }

 private:
  Status add_store(const fs::path& store) {
    SHOAL_RETURN_IF_ERROR(project_pending());
    SHOAL_ASSIGN_OR_RETURN(stored, load_store(store));
    append(std::move(stored), library_);
    return {};
  }

  Status add_table(const fs::path& table) {
    SHOAL_RETURN_IF_ERROR(project_pending());
    SHOAL_ASSIGN_OR_RETURN(records, read_table(table));
    if (table.extension() == ".csv" && !take_frames(table, settings_.table_frame, records)) {
      library_.frameless.push_back(table);
    }
    append({"", panoramas_of(std::move(records)), {}, {}}, library_);
    return {};
  }

  Status add_folder(const fs::path& folder) {
    if (is_there(folder / kStoreName)) return add_store(folder / kStoreName);
    for (const std::string_view name : {kJsonTableName, kCsvTableName}) {
      if (is_there(folder / name)) return add_table(folder / name);
    }
    SHOAL_ASSIGN_OR_RETURN(pictures, pictures_below(folder));
    if (pictures.empty()) return nothing_in(folder);
    pending_.insert(pending_.end(), pictures.begin(), pictures.end());
    return {};
  }

  Status project_pending() {
    if (pending_.empty()) return {};
    SHOAL_ASSIGN_OR_RETURN(projected, project_files(std::exchange(pending_, {}), settings_));
    append(std::move(projected), library_);
    return {};
  }

  LoadSettings settings_;
  Library library_;
  std::vector<fs::path> pending_;
};

std::string title_of(const std::vector<fs::path>& sources) {
  if (sources.size() != 1) return std::to_string(sources.size()) + " sources";
  std::error_code code;
  fs::path path = fs::absolute(sources.front(), code).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "out/"
  if (path.filename() == kStoreName) path = path.parent_path();
  return path.filename().string();
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

bool matches(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

template <typename Is>
std::vector<std::size_t> indices_of(const Library& library, const Is& is) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < library.panoramas.size(); ++i) {
    if (is(library.panoramas[i])) found.push_back(i);
  }
  return found;
}

}  // namespace

Result<Library> load_library(const std::vector<fs::path>& sources, const LoadSettings& settings) {
  Loader loader(settings);
  for (const fs::path& source : sources) SHOAL_RETURN_IF_ERROR(loader.add(source));
  SHOAL_ASSIGN_OR_RETURN(library, loader.finish());
  library.title = title_of(sources);
  return library;
}

Coefficients coefficients_in(const Panorama& panorama, Quantity quantity, const Frame& frame) {
  if (panorama.frame == frame) {
    const auto told = panorama.told.find(quantity);
    if (told != panorama.told.end()) return told->second;
    const auto radiance = panorama.told.find(Quantity::radiance);
    if (radiance != panorama.told.end()) return apply_quantity(radiance->second, quantity);
  }
  return apply_quantity(to_frame(radiance_of(panorama), frame), quantity);
}

std::string full_name(const Panorama& panorama) {
  return panorama.variant.empty() ? panorama.name : panorama.name + "." + panorama.variant;
}

std::string variant_of(const Panorama& panorama) {
  return panorama.variant.empty() ? std::string(kPlainVariant) : panorama.variant;
}

std::string variant_name(const Panorama& panorama) {
  return panorama.name + "." + variant_of(panorama);
}

Coefficients radiance_of(const Panorama& panorama) {
  Coefficients radiance = panorama.coefficients;
  for (auto& channel : radiance.channels) {
    for (int l = 0; l <= radiance.degree; ++l) {
      const double gain = quantity_gain(panorama.quantity, l);
      for (int m = -l; m <= l; ++m) {
        double& value = channel[coefficient_index(l, m)];
        value = gain == 0.0 ? 0.0 : value / gain;
      }
    }
  }
  return radiance;
}

std::vector<std::size_t> find_panoramas(const Library& library, const std::string& pattern) {
  std::vector<std::size_t> exact = indices_of(library, [&](const Panorama& panorama) {
    return panorama.name == pattern || variant_name(panorama) == pattern;
  });
  if (!exact.empty()) return exact;
  return indices_of(library, [&](const Panorama& panorama) {
    return matches(pattern, panorama.name) || matches(pattern, variant_name(panorama));
  });
}

Frame frame_of(const Library& library) {
  if (library.panoramas.empty()) return {};
  const Frame& first = library.panoramas.front().frame;
  const bool is_common = std::ranges::all_of(
      library.panoramas, [&](const Panorama& panorama) { return panorama.frame == first; });
  return is_common ? first : Frame{};
}

std::string count_text(const Library& library) {
  std::map<std::pair<std::string, fs::path>, std::size_t> variants;  // of each name and file
  for (const Panorama& panorama : library.panoramas) ++variants[{panorama.name, panorama.file}];
  const std::size_t count = library.panoramas.size();
  std::string text = counted(variants.size(), "panorama");
  if (variants.size() == count) return text;
  const std::size_t first = variants.begin()->second;
  const bool is_even =
      std::ranges::all_of(variants, [&](const auto& panorama) { return panorama.second == first; });
  if (!is_even) return text + ", " + counted(count, "variant") + " in all";
  return text + ", " + counted(first, "variant") + (variants.size() == 1 ? "" : " each");
}

Library part_of(const Library& library, std::span<const std::size_t> panoramas) {
  Library part;
  part.title = library.title;
  part.failed = library.failed;
  for (const std::size_t index : panoramas) part.panoramas.push_back(library.panoramas[index]);
  return part;
}

}  // namespace shoal::viz
