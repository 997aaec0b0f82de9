// Small pictures of panoramas.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/result.h"
#include "library/library.h"

namespace shoal::viz {

// An equirect picture, (height, width, 3) linear Rec.709 radiance, the top row first; the native
// frame's theta runs down, phi to the right.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;

  [[nodiscard]] bool empty() const { return rgb.empty(); }
  [[nodiscard]] const float* at(int row, int column) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(row) * width + column);
  }
};

// The panoramas at `width` x width/2 texels, each the mean of those it covers, in the order asked
// for; an Error where one cannot be read. All of them are made by one run of `shoal preview`, with
// all processors. `layout`: of those files that do not say themselves what they are.
[[nodiscard]] std::vector<Result<Pixels>> load_previews(
    const std::vector<std::filesystem::path>& files, int width, Layout layout = Layout::equirect);

// Which way pixels lie: turned as the light is, to be looked at, or as in the file, exact texels
// for who turns what he does with them.
enum class Lying { turned, as_in_file };

// Previews of a library's panoramas, loaded when they are first asked for. The last 64 that were
// asked for are kept, and others while there is room (256 MiB).
class PixelCache {
 public:
  explicit PixelCache(const Library& library) : library_(library) {}

  // Says in which order panoramas are going to be asked for, so that those that follow one are
  // loaded with it, many at once.
  void expect(std::vector<std::size_t> panoramas);

  // Loads at once what is not there yet of these panoramas, and keeps all of them.
  void prepare(std::span<const std::size_t> panoramas, int width);

  // The panorama's light: Panorama::change is applied where it is known, else these are the pixels
  // of the file. Empty where there is no file, or one that cannot be read (why_empty says so). The
  // reference lives until 64 others have been asked for.
  [[nodiscard]] const Pixels& get(std::size_t panorama, int width, Lying lying = Lying::turned);
  [[nodiscard]] std::string why_empty(std::size_t panorama) const;

 private:
  using Key = std::tuple<std::size_t, int, Lying>;  // panorama, width
  using Load = std::function<std::vector<Result<Pixels>>(const std::vector<std::string>&, int)>;
  struct Entry {
    Pixels pixels;
    std::int64_t last_use = 0;
  };

  void take(const std::map<std::string, std::vector<std::size_t>>& users, int width,
            const Load& load);
  void keep(const Key& key, Pixels pixels);
  void make_room(std::size_t kept);

  const Library& library_;
  std::vector<std::size_t> expected_;
  std::map<Key, Entry> entries_;
  std::int64_t use_count_ = 0;
  std::size_t byte_count_ = 0;
  std::map<std::size_t, std::string> failures_;
};

}  // namespace shoal::viz
