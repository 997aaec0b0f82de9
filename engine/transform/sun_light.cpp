#include "transform/sun_light.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace shoal {
namespace {

// The region of the first of some texels.
class RegionSearch {
 public:
  RegionSearch(const std::vector<BrightTexel>& texels, std::size_t count, int width, int height)
      : texels_(texels), width_(width), height_(height) {
    for (std::size_t i = 0; i < count; ++i)
      index_by_place_[place(texels[i].row, texels[i].column)] = i;
  }

  // Ascending.
  std::vector<std::size_t> region_of_first() {
    visit(texels_[0].row, texels_[0].column);
    for (std::size_t next = 0; next < region_.size(); ++next) {
      const auto [row, column] =
          std::pair(texels_[region_[next]].row, texels_[region_[next]].column);
      for (int i = std::max(row - 1, 0); i <= std::min(row + 1, height_ - 1); ++i) {
        for (const int j : {column - 1, column, column + 1}) visit(i, (j + width_) % width_);
      }
      if (row == 0 || row == height_ - 1) visit_row(row);
    }
    std::ranges::sort(region_);
    return std::move(region_);
  }

 private:
  [[nodiscard]] std::int64_t place(int row, int column) const {
    return std::int64_t{row} * width_ + column;
  }

  void visit(int row, int column) {
    const auto found = index_by_place_.extract(place(row, column));
    if (!found.empty()) region_.push_back(found.mapped());
  }

  // All texels of the first or of the last row touch in a pole.
  void visit_row(int row) {
    bool& done = row == 0 ? top_done_ : bottom_done_;
    if (std::exchange(done, true)) return;
    for (int column = 0; column < width_; ++column) visit(row, column);
  }

  const std::vector<BrightTexel>& texels_;
  const int width_;
  const int height_;
  std::unordered_map<std::int64_t, std::size_t> index_by_place_;  // those not visited
  std::vector<std::size_t> region_;
  bool top_done_ = false;
  bool bottom_done_ = false;
};

Result<float> sun_level(const BrightestTexels& bright, const SunSettings& settings) {
  if (settings.top > 0.0) return bright.threshold(settings.top);
  const auto level = static_cast<float>(settings.above);
  if (bright.threshold(kMostBright) <= level) return level;
  return Error{ErrorCode::pixels,
               fmt::format("more than {:g} % of the sphere is brighter than {:g}",
                           100.0 * kMostBright, settings.above),
               "", ""};
}

glm::dvec3 vector_of(const std::array<float, kMaxChannels>& samples) {
  return {samples[0], samples[1], samples[2]};
}

}  // namespace

BrightTexel lowered(const BrightTexel& texel, float level) {
  BrightTexel rest = texel;
  const double part = static_cast<double>(level) / texel.value();
  for (float& sample : rest.samples) sample = static_cast<float>(part * sample);
  return rest;
}

Result<FoundSun> find_sun(const BrightestTexels& bright, const SunSettings& settings,
                          const TexelPlaces& places) {
  SHOAL_ASSIGN_OR_RETURN(level, sun_level(bright, settings));
  const auto& texels = bright.texels;
  const auto above = std::ranges::find_if(
      texels, [level](const BrightTexel& texel) { return !(texel.value() > level); });
  const auto count = static_cast<std::size_t>(above - texels.begin());
  if (count == 0) {
    return Error{ErrorCode::pixels,
                 settings.top > 0.0 ? "its brightest light is evenly bright over a larger region"
                                    : fmt::format("nothing is brighter than {:g}", settings.above),
                 "", ""};
  }
  FoundSun found;
  found.members = RegionSearch(texels, count, places.width, places.height).region_of_first();
  Sun& sun = found.sun;
  sun.level = level;
  sun.texel_count = static_cast<std::int64_t>(found.members.size());
  // Weighted by the largest channel, that no colour space changes and that is above 0.
  glm::dvec3 centroid(0.0);
  glm::dmat3 flux_by_axis(0.0);  // column k: flux times component k of the direction
  for (const std::size_t i : found.members) {
    const Texel texel = places.texel(texels[i].row, texels[i].column);
    const glm::dvec3 flux = texel.solid_angle * (vector_of(texels[i].samples) -
                                                 vector_of(lowered(texels[i], level).samples));
    sun.solid_angle += texel.solid_angle;
    sun.flux += flux;
    centroid += texel.solid_angle * (texels[i].value() - level) * texel.direction;
    for (int axis = 0; axis < 3; ++axis) flux_by_axis[axis] += flux * texel.direction[axis];
  }
  sun.direction = glm::normalize(centroid);
  sun.irradiance = flux_by_axis * sun.direction;
  // 2 pi (1 - cos a), by the half angle so that small ones lose nothing.
  sun.angular_radius = 2.0 * std::asin(std::sqrt(sun.solid_angle / (4.0 * std::numbers::pi)));
  return found;
}

}  // namespace shoal
