#include "app/output_names.h"

#include <fmt/format.h>

#include <set>
#include <system_error>

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

struct NamedFormat {
  std::string_view name;
  OutputFormat format;
};
constexpr NamedFormat kFormats[] = {{"png", OutputFormat::png},
                                    {"vtp", OutputFormat::vtp},
                                    {"gltf", OutputFormat::gltf},
                                    {"glb", OutputFormat::glb}};

const NamedFormat* format_named(std::string_view name) {
  for (const NamedFormat& format : kFormats) {
    if (format.name == name) return &format;
  }
  return nullptr;
}

std::string_view name_of(OutputFormat format) {
  for (const NamedFormat& known : kFormats) {
    if (known.format == format) return known.name;
  }
  return "";
}

bool is_folder(const std::string& output) {
  std::error_code code;
  return output.ends_with('/') || fs::is_directory(output, code);
}

// A name as a path that stays below the folder it is put in.
std::string below(const std::string& name) {
  fs::path path;
  for (const fs::path& part : fs::path(name).relative_path()) {
    if (part.empty() || part == ".") continue;
    path /= part == ".." ? "__" : part;
  }
  return path.empty() ? "_" : path.string();
}

std::string replaced(std::string text, std::string_view what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

}  // namespace

Result<OutputFormat> output_format(const std::string& output, const std::string& format) {
  const NamedFormat* asked = format_named(format);
  if (is_folder(output)) return asked ? asked->format : OutputFormat::png;
  const std::string extension = fs::path(output).extension().string();
  const NamedFormat* told = extension.empty() ? nullptr : format_named(extension.substr(1));
  if (!told) {
    return Error{ErrorCode::usage, "ends in none of .png, .vtp, .gltf and .glb", output,
                 "a folder ends in /"};
  }
  if (asked && asked != told) {
    return Error{ErrorCode::usage, fmt::format("its extension is not that of --format {}", format),
                 output, "leave --format out"};
  }
  return told->format;
}

Result<std::vector<fs::path>> output_files(const std::string& output, OutputFormat format,
                                           std::string_view placeholder,
                                           const std::vector<std::string>& names) {
  std::string pattern = output;
  if (is_folder(output)) {
    pattern +=
        fmt::format("{}{}.{}", output.ends_with('/') ? "" : "/", placeholder, name_of(format));
  }
  if (names.size() > 1 && pattern.find(placeholder) == std::string::npos) {
    return Error{
        ErrorCode::usage, fmt::format("one file for {} pictures", names.size()), output,
        fmt::format("a folder, -o DIR/, or {} in the file's name gives each its own; {} "
                    "chooses one",
                    placeholder, placeholder == "{page}" ? "--page" : "--panorama NAME.VARIANT")};
  }
  std::vector<fs::path> files;
  std::set<fs::path> taken;
  for (const std::string& name : names) {
    files.emplace_back(replaced(pattern, placeholder, below(name)));
    if (!taken.insert(files.back()).second) {
      return Error{ErrorCode::usage, "would be the file of two panoramas", files.back().string(),
                   "name one of the sources alone, or choose with --panorama"};
    }
  }
  return files;
}

}  // namespace shoal::viz
