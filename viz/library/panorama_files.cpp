#include "library/panorama_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "library/program.h"
#include "output/coefficient_table.h"

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

// Those that `shoal init` takes for panoramas.
constexpr std::string_view kExtensions[] = {".exr",  ".hdr", ".pfm", ".pic",
                                            ".rgbe", ".tif", ".tiff"};

bool is_picture(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(kExtensions, extension) != std::end(kExtensions);
}

// Names by file; those that two files would share are paths instead.
std::map<std::string, std::string> names_of(const std::vector<std::string>& files) {
  std::map<std::string, int> uses;
  for (const std::string& file : files) ++uses[fs::path(file).stem().string()];
  std::map<std::string, std::string> names;
  for (const std::string& file : files) {
    const std::string stem = fs::path(file).stem().string();
    names[file] = uses[stem] == 1 ? stem : file;
  }
  return names;
}

// `shoal` says "failed: FILE[:ROW]: why" of each file that it cannot project.
std::string failure_of(const std::string& messages, const std::string& file) {
  const std::string mark = "failed: " + file + ":";
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(mark)) return line.substr(std::string_view("failed: ").size());
  }
  return "`shoal project` gave no coefficients of it";
}

// The same of warnings: "warning: FILE: text".
std::vector<std::string> warnings_of(const std::string& messages, const std::string& file) {
  const std::string mark = "warning: " + file + ": ";
  std::vector<std::string> warnings;
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(mark)) warnings.push_back(line.substr(mark.size()));
  }
  return warnings;
}

Status project_batch(const fs::path& shoal, std::span<const std::string> files,
                     const LoadSettings& settings, const std::map<std::string, std::string>& names,
                     Library& library) {
  std::vector<std::string> arguments{"project"};
  if (settings.degree) {
    arguments.insert(arguments.end(), {"--degree", std::to_string(*settings.degree)});
  }
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), files.begin(), files.end());
  SHOAL_ASSIGN_OR_RETURN(finished, run_program(shoal, arguments));
  std::map<std::string, Coefficients> found;
  std::istringstream table(finished.out);
  Status read = read_csv_table(table, shoal.string() + " project", [&](CoefficientRecord record) {
    found[record.panorama] = std::move(record.coefficients);
    return Status();
  });
  if (!read) {
    return Error{ErrorCode::unreadable, "the panoramas cannot be projected: " + finished.err,
                 shoal.string(), ""};
  }
  for (const std::string& file : files) {
    const auto coefficients = found.find(file);
    if (coefficients == found.end()) {
      library.failed.push_back({names.at(file), failure_of(finished.err, file), file});
      continue;
    }
    Panorama panorama;
    panorama.name = names.at(file);
    panorama.file = file;
    panorama.coefficients = coefficients->second;
    panorama.warnings = warnings_of(finished.err, file);
    library.panoramas.push_back(std::move(panorama));
  }
  return {};
}

}  // namespace

Result<std::vector<fs::path>> pictures_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  const auto options = fs::directory_options::skip_permission_denied;
  fs::recursive_directory_iterator entry(folder, options, code);
  for (; !code && entry != fs::recursive_directory_iterator(); entry.increment(code)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && is_picture(entry->path())) {
      files.push_back(entry->path());
    }
  }
  if (code) return Error{ErrorCode::unreadable, code.message(), folder.string(), ""};
  std::ranges::sort(files);
  return files;
}

Result<Library> project_files(const std::vector<fs::path>& files, const LoadSettings& settings) {
  SHOAL_ASSIGN_OR_RETURN(shoal, find_shoal());
  std::vector<std::string> paths;
  for (const fs::path& file : files) {
    if (std::ranges::find(paths, file.string()) == paths.end()) paths.push_back(file.string());
  }
  const std::map<std::string, std::string> names = names_of(paths);
  Library library;
  for (const Range& batch : command_line_batches(paths)) {
    const auto part = std::span(paths).subspan(batch.begin, batch.end - batch.begin);
    SHOAL_RETURN_IF_ERROR(project_batch(shoal, part, settings, names, library));
  }
  return library;
}

}  // namespace shoal::viz
