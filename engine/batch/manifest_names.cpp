#include "batch/manifest_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace shoal {
namespace {

std::string_view without_extension(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t begin = slash == std::string_view::npos ? 0 : slash + 1;
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos || dot <= begin ? path : path.substr(0, dot);
}

std::string place(const SourceLoc& loc) {
  return fmt::format("{}:{}:{}", loc.file, loc.line, loc.column);
}

// Panoramas of equal names, by the places of the two: a thousand of them are one diagnostic.
struct Clash {
  std::size_t first = 0;  // indices of panoramas
  std::size_t second = 0;
  int count = 0;
};

void tell_clash(const Clash& clash, const std::vector<PanoramaEntry>& panoramas,
                const SourceLoc& loc, ManifestLog& log) {
  const PanoramaEntry& first = panoramas[clash.first];
  const PanoramaEntry& second = panoramas[clash.second];
  std::string message =
      first.file == second.file
          ? fmt::format("{} is taken twice", in_quotes(second.file))
          : fmt::format("two panoramas are named {}: {} and {}", in_quotes(second.name),
                        in_quotes(first.file), in_quotes(second.file));
  if (clash.count > 1) message += fmt::format(", and {} more like it", clash.count - 1);
  log.error(
      loc, std::move(message),
      fmt::format("the first is of {}; exclude one, or give it a name", place(first.origin->loc)));
}

}  // namespace

std::string name_fault(std::string_view name) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (std::any_of(name.begin(), name.end(), is_control)) return "holds control characters";
  if (name.starts_with('/')) return "begins with a slash";
  for (std::string_view rest = name;;) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view part = rest.substr(0, slash);
    if (part == "..") return "leads out of the output folder";
    if (part.empty() || part == ".") return "has an empty part";
    if (slash == rest.size()) return "";
    rest.remove_prefix(slash + 1);
  }
}

void PanoramaNames::add_given(std::string name, SourceLoc loc) {
  names_.push_back({std::move(name), std::move(loc)});
}

void PanoramaNames::add_path(std::string path) { names_.push_back({std::move(path), {}}); }

void PanoramaNames::assign(std::vector<PanoramaEntry>& panoramas, ManifestLog& log) const {
  std::unordered_map<std::string_view, int> short_counts;
  for (const Name& name : names_) {
    if (!name.is_given()) ++short_counts[without_extension(name.text)];
  }
  std::unordered_map<std::string_view, std::size_t> owners;
  std::map<std::tuple<std::string, int, int, std::string, int, int>, Clash> clashes;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const Name& name = names_[i];
    const std::string_view shorter = name.is_given() ? name.text : without_extension(name.text);
    const bool stays = !name.is_given() && short_counts[shorter] > 1;
    const std::string_view chosen = stays ? std::string_view(name.text) : shorter;
    panoramas[i].name = chosen;
    const SourceLoc& loc = name.is_given() ? name.given_at : panoramas[i].origin->loc;
    if (const std::string fault = name_fault(chosen); !name.is_given() && !fault.empty()) {
      log.error(loc, fmt::format("the name {} {}", in_quotes(chosen), fault),
                "exclude the file, or take it alone with file: and name:");
    }
    const auto [owner, is_new] = owners.try_emplace(chosen, i);
    if (is_new) continue;
    const SourceLoc& other = panoramas[owner->second].origin->loc;
    Clash& clash = clashes[{other.file, other.line, other.column, loc.file, loc.line, loc.column}];
    if (clash.count++ == 0) clash = {owner->second, i, 1};
  }
  for (const auto& [key, clash] : clashes) {
    const Name& name = names_[clash.second];
    const SourceLoc& loc = name.is_given() ? name.given_at : panoramas[clash.second].origin->loc;
    tell_clash(clash, panoramas, loc, log);
  }
}

}  // namespace shoal
