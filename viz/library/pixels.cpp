#include "library/pixels.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "library/changed_pixels.h"
#include "library/exr_pixels.h"
#include "library/painted_pixels.h"
#include "library/program.h"
#include "library/temporary_folder.h"

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
constexpr std::size_t kKeptEntries = 8;
constexpr std::size_t kMostReadAhead = 32;  // and no more than half of all that is kept

// What `shoal preview` says of one file: a line of JSON.
Result<Pixels> take_line(const std::string& line, const fs::path& file) {
  const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
  Json::Value said;
  std::string complaint;
  if (!reader->parse(line.data(), line.data() + line.size(), &said, &complaint) ||
      !said.isObject()) {
    return Error{ErrorCode::unreadable, "`shoal preview` said nothing of it", file.string(), ""};
  }
  if (said.isMember("error")) {
    const std::string why = said["error"].asString();
    const bool says_where = why.starts_with(file.string() + ":");  // or a row of it
    return Error{ErrorCode::unreadable, why, says_where ? "" : file.string(), ""};
  }
  return read_exr(said["output"].asString());
}

void preview_batch(const fs::path& shoal, std::span<const std::string> files, int width,
                   Layout layout, std::vector<Result<Pixels>>& previews) {
  const auto fail_all = [&](const Error& error) {
    for (std::size_t i = 0; i < files.size(); ++i) previews.emplace_back(error);
  };
  auto folder = TemporaryFolder::make();
  if (!folder) return fail_all(folder.error());
  std::vector<std::string> arguments{"preview",
                                     "--width",
                                     std::to_string(width),
                                     "--layout",
                                     std::string(name_of(layout)),
                                     "-o",
                                     folder->path().string(),
                                     "--"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  auto finished = run_program(shoal, arguments);
  if (!finished) return fail_all(finished.error());
  std::istringstream lines(finished->out);
  for (const std::string& file : files) {
    std::string line;
    std::getline(lines, line);
    previews.push_back(take_line(line, file));
  }
}

std::size_t read_ahead_of(int width) {
  const std::size_t bytes = std::size_t{3} * sizeof(float) * width * (width / 2);
  return std::clamp(kMaxBytes / 2 / bytes, std::size_t{1}, kMostReadAhead);
}

}  // namespace

std::vector<Result<Pixels>> load_previews(const std::vector<fs::path>& files, int width,
                                          Layout layout) {
  const auto shoal = find_shoal();
  if (!shoal) return {files.size(), Result<Pixels>(shoal.error())};
  std::vector<std::string> paths;
  for (const fs::path& file : files) paths.push_back(file.string());
  std::vector<Result<Pixels>> previews;
  for (const Range& batch : command_line_batches(paths)) {
    preview_batch(*shoal, std::span(paths).subspan(batch.begin, batch.end - batch.begin), width,
                  layout, previews);
  }
  return previews;
}

void PixelCache::expect(std::vector<std::size_t> panoramas) { expected_ = std::move(panoramas); }

void PixelCache::prepare(std::span<const std::size_t> panoramas, int width) {
  // Variants share their panorama's file or recipe.
  std::map<Layout, std::map<std::string, std::vector<std::size_t>>> files;
  std::map<std::string, std::vector<std::size_t>> recipes;
  for (const std::size_t panorama : panoramas) {
    if (const auto known = entries_.find({panorama, width, Lying::as_in_file});
        known != entries_.end()) {
      known->second.last_use = ++use_count_;
      continue;
    }
    const Panorama& wanted = library_.panoramas[panorama];
    if (!wanted.file.empty()) {
      files[wanted.layout][wanted.file.string()].push_back(panorama);
    } else if (!wanted.recipe.empty()) {
      recipes[wanted.recipe].push_back(panorama);
    } else {
      failures_[panorama] = "it is known by its coefficients alone";
      keep({panorama, width, Lying::as_in_file}, {});
    }
  }
  if (files.empty() && recipes.empty()) return;
  for (const auto& [layout, users] : files) {
    take(users, width, [&layout](const std::vector<std::string>& texts, int size) {
      return load_previews({texts.begin(), texts.end()}, size, layout);
    });
  }
  take(recipes, width, paint);
  make_room(std::max(kKeptEntries, panoramas.size()));
}

void PixelCache::take(const std::map<std::string, std::vector<std::size_t>>& users, int width,
                      const Load& load) {
  if (users.empty()) return;
  std::vector<std::string> sources;
  for (const auto& [source, panoramas] : users) sources.push_back(source);
  const std::vector<Result<Pixels>> loaded = load(sources, width);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (const std::size_t panorama : users.at(sources[i])) {
      if (!loaded[i]) failures_[panorama] = loaded[i].error().text();
      Pixels pixels = loaded[i] ? *loaded[i] : Pixels();
      const auto& change = library_.panoramas[panorama].change;
      if (change.colour != glm::dmat3(1.0)) apply_colour(change.colour, pixels);
      keep({panorama, width, Lying::as_in_file}, std::move(pixels));
    }
  }
}

const Pixels& PixelCache::get(std::size_t panorama, int width, Lying lying) {
  const Key in_file{panorama, width, Lying::as_in_file};
  if (!entries_.contains(in_file)) {
    const auto expected = std::ranges::find(expected_, panorama);
    const auto left = static_cast<std::size_t>(expected_.end() - expected);
    const std::size_t ahead = std::min(left, read_ahead_of(width));
    const std::vector<std::size_t> together(expected, expected + ahead);
    prepare(together.empty() ? std::span(&panorama, 1) : std::span(together), width);
  }
  const auto& change = library_.panoramas[panorama].change;
  const bool turns = lying == Lying::turned && change.turn != glm::dmat3(1.0);
  const Key key{panorama, width, turns ? Lying::turned : Lying::as_in_file};
  if (turns && !entries_.contains(key)) {
    const Pixels& pixels = entries_[in_file].pixels;
    keep(key, pixels.empty() ? Pixels() : turned(pixels, change.turn));
  }
  Entry& entry = entries_[key];
  entry.last_use = ++use_count_;
  return entry.pixels;
}

std::string PixelCache::why_empty(std::size_t panorama) const {
  const auto failure = failures_.find(panorama);
  return failure == failures_.end() ? "" : failure->second;
}

void PixelCache::keep(const Key& key, Pixels pixels) {
  byte_count_ += pixels.rgb.size() * sizeof(float);
  entries_[key] = {std::move(pixels), ++use_count_};
}

// Lets go of what was not asked for the longest, but not of the last `kept`.
void PixelCache::make_room(std::size_t kept) {
  if (byte_count_ <= kMaxBytes || entries_.size() <= kept) return;
  std::vector<std::pair<std::int64_t, Key>> by_use;
  for (const auto& [key, entry] : entries_) by_use.emplace_back(entry.last_use, key);
  std::ranges::sort(by_use);
  for (std::size_t i = 0; byte_count_ > kMaxBytes && i + kept < by_use.size(); ++i) {
    const auto entry = entries_.find(by_use[i].second);
    byte_count_ -= entry->second.pixels.rgb.size() * sizeof(float);
    entries_.erase(entry);
  }
}

}  // namespace shoal::viz
