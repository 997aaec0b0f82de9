#include "batch/manifest_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "batch/glob.h"
#include "batch/manifest_names.h"
#include "image/face_files.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMapFolders[] = {"maps", "exports"};

// A name of the file's folder that is near to the file's, in quotes as a question, or "".
std::string nearby_file(const fs::path& file) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::vector<std::string> names;
  for (fs::directory_iterator it(folder, error); !error && it != fs::directory_iterator();
       it.increment(error)) {
    names.push_back(it->path().filename().string());
  }
  if (error) return fmt::format("{}: {}", folder.string(), error.message());
  std::sort(names.begin(), names.end());
  return did_you_mean(file.filename().string(), {names.begin(), names.end()});
}

void check_name(const EntryText& entry, ManifestLog& log) {
  if (const std::string fault = entry.name ? name_fault(entry.name->text) : ""; !fault.empty()) {
    log.error(entry.name->loc, fmt::format("the name {} {}", in_quotes(entry.name->text), fault));
  }
}

void find_file(const EntryText& entry, PanoramaNames& names, std::vector<PanoramaEntry>& found,
               ManifestLog& log) {
  const fs::path file = (entry.folder / entry.file->text).lexically_normal();
  const SourceLoc& loc = entry.file->loc;
  check_name(entry, log);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) {
    return log.error(loc, fmt::format("{} is a folder", in_quotes(file.string())),
                     "files: \"FOLDER/*.hdr\" takes what lies in it");
  }
  if (!fs::exists(status)) {
    const bool is_pattern = entry.file->text.find_first_of("*?[{") != std::string::npos;
    return log.error(loc, fmt::format("no file {}", in_quotes(file.string())),
                     is_pattern ? "patterns go under files:" : nearby_file(file));
  }
  if (!fs::is_regular_file(status)) {
    return log.error(loc, fmt::format("{} is not a regular file", in_quotes(file.string())));
  }
  if (entry.name) {
    names.add_given(entry.name->text, entry.name->loc);
  } else {
    names.add_path(file.filename().string());
  }
  found.push_back({"", file.string(), std::make_shared<EntrySettings>(entry.settings),
                   std::make_shared<EntryOrigin>(EntryOrigin{"", entry.loc})});
}

// A panorama of a sky, or of lights alone.
void find_fileless(const EntryText& entry, PanoramaNames& names, std::vector<PanoramaEntry>& found,
                   ManifestLog& log) {
  check_name(entry, log);
  names.add_given(entry.name->text, entry.name->loc);
  found.push_back({"", "", std::make_shared<EntrySettings>(entry.settings),
                   std::make_shared<EntryOrigin>(EntryOrigin{"", entry.loc})});
}

// An exclude: pattern with whether it has excluded anything.
struct Exclude {
  Glob glob;
  LocatedText source;
  bool used = false;
};

std::vector<Exclude> parse_excludes(const EntryText& entry, ManifestLog& log) {
  std::vector<Exclude> excludes;
  for (const LocatedText& source : entry.exclude) {
    Result<Glob> glob = Glob::parse(source.text);
    if (glob)
      excludes.push_back({std::move(glob).value(), source});
    else
      log.error(source.loc, glob.error().what, glob.error().hint);
  }
  return excludes;
}

// Patterns look at what names are made of, and at the path as files: would spell it.
bool is_excluded(std::vector<Exclude>& excludes, const std::string& path,
                 const std::string& fixed_part) {
  bool excluded = false;
  for (Exclude& exclude : excludes) {
    if (!exclude.glob.selects(path) && !exclude.glob.matches(fixed_part + path)) continue;
    exclude.used = true;
    excluded = true;
  }
  return excluded;
}

// What begins the paths below `root` that lie in the folders of maps.
std::vector<std::string> output_prefixes(const fs::path& root, const fs::path& output) {
  std::vector<std::string> prefixes;
  std::error_code error;
  const fs::path base = fs::weakly_canonical(fs::absolute(root, error), error);
  for (const std::string_view folder : kMapFolders) {
    const fs::path maps = fs::weakly_canonical(fs::absolute(output / folder, error), error);
    const std::string below = maps.lexically_relative(base / "").string();
    if (!below.starts_with("..")) prefixes.push_back(below == "." ? "" : below + "/");
  }
  return prefixes;
}

// Why a pattern has found nothing, as far as can be told.
std::string why_nothing(const LocatedText& pattern, const EntryText& entry, const Glob& glob,
                        const GlobMatches& matches) {
  if (!matches.paths.empty()) return "maps that shoal itself has written are left out";
  if (!matches.unreadable.empty()) {
    return fmt::format("{}: {}", matches.unreadable[0].path, matches.unreadable[0].reason);
  }
  if (pattern.text.find("**") != std::string::npos) return "";
  const std::string& fixed = glob.fixed_part();
  if (!pattern.text.starts_with(fixed)) return "";
  const std::string deeper = fixed + "**/" + pattern.text.substr(fixed.size());
  const Result<Glob> deep_glob = Glob::parse(deeper);
  if (!deep_glob || deep_glob->expand(entry.folder).paths.empty()) return "";
  return fmt::format("in folders below there are some: {}", in_quotes(deeper));
}

struct Search {
  const EntryText& entry;
  const fs::path& output;
  std::shared_ptr<const EntrySettings> settings;
  std::vector<Exclude> excludes;
  std::unordered_set<std::string> taken;  // where there are several patterns: they may overlap
};

// Whether the file is one of six faces of which another stands for all: the first one that matches.
bool is_further_face(const std::string& path, const std::string& root, const GlobMatches& matches,
                     Layout layout) {
  if (layout != Layout::automatic && layout != Layout::cube_faces) return false;
  const auto faces = existing_face_paths(root + path);
  if (!faces) return false;
  const auto matching = std::ranges::find_if(*faces, [&](const fs::path& face) {
    const std::string& text = face.native();
    return text.starts_with(root) &&
           std::ranges::binary_search(matches.paths, text.substr(root.size()));
  });
  return matching != faces->end() && *matching != root + path;
}

// How many matches of a pattern are no maps of shoal's own, and how many of these are excluded.
struct MatchCounts {
  std::size_t eligible = 0;
  std::size_t excluded = 0;
};

MatchCounts take_matches(const LocatedText& pattern, const Glob& glob, const GlobMatches& matches,
                         Search& search, PanoramaNames& names, std::vector<PanoramaEntry>& found) {
  const std::vector<std::string> skipped = output_prefixes(matches.root, search.output);
  const std::string root = (matches.root / "").string();
  const auto origin = std::make_shared<EntryOrigin>(EntryOrigin{pattern.text, pattern.loc});
  MatchCounts counts;
  for (const std::string& path : matches.paths) {
    const auto is_below = [&path](const std::string& prefix) { return path.starts_with(prefix); };
    if (std::any_of(skipped.begin(), skipped.end(), is_below)) continue;
    ++counts.eligible;
    if (is_excluded(search.excludes, path, glob.fixed_part())) {
      ++counts.excluded;
      continue;
    }
    if (is_further_face(path, root, matches, search.settings->projection.layout)) continue;
    std::string file = root + path;
    if (search.entry.files.size() > 1 && !search.taken.insert(file).second) continue;
    names.add_path(path);
    found.push_back({"", std::move(file), search.settings, origin});
  }
  return counts;
}

void find_pattern(const LocatedText& pattern, Search& search, PanoramaNames& names,
                  std::vector<PanoramaEntry>& found, ManifestLog& log) {
  const Result<Glob> glob = Glob::parse(pattern.text);
  if (!glob) return log.error(pattern.loc, glob.error().what, glob.error().hint);
  const GlobMatches matches = glob->expand(search.entry.folder);
  const MatchCounts counts = take_matches(pattern, *glob, matches, search, names, found);
  if (counts.eligible == 0) {
    log.error(pattern.loc, fmt::format("no file matches {}", in_quotes(pattern.text)),
              why_nothing(pattern, search.entry, *glob, matches));
    return;
  }
  if (counts.excluded == counts.eligible) {
    log.error(pattern.loc, "every file that matches is excluded");
  }
  for (const UnreadableFolder& folder : matches.unreadable) {
    log.warning(pattern.loc,
                fmt::format("{} cannot be searched: {}", in_quotes(folder.path), folder.reason));
  }
}

void find_files(const EntryText& entry, const fs::path& output, PanoramaNames& names,
                std::vector<PanoramaEntry>& found, ManifestLog& log) {
  Search search{entry,
                output,
                std::make_shared<EntrySettings>(entry.settings),
                parse_excludes(entry, log),
                {}};
  const std::size_t before = found.size();
  for (const LocatedText& pattern : entry.files) find_pattern(pattern, search, names, found, log);
  if (found.size() == before) return;
  for (const Exclude& exclude : search.excludes) {
    if (exclude.used) continue;
    log.warning(exclude.source.loc,
                fmt::format("{} excludes nothing", in_quotes(exclude.source.text)),
                "patterns see the path below the first folder with a wildcard");
  }
}

}  // namespace

std::vector<PanoramaEntry> find_panoramas(const std::vector<EntryText>& entries,
                                          const fs::path& output, ManifestLog& log) {
  std::vector<PanoramaEntry> found;
  PanoramaNames names;
  for (const EntryText& entry : entries) {
    if (entry.file)
      find_file(entry, names, found, log);
    else if (entry.settings.origin != LightOrigin::file)
      find_fileless(entry, names, found, log);
    else
      find_files(entry, output, names, found, log);
  }
  names.assign(found, log);
  return found;
}

}  // namespace shoal
