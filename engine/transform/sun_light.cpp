#include "transform/sun_light.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

namespace shoal {
namespace {

// The region of the first of some texels.
class RegionSearch {
 public:
  RegionSearch(const std::vector<BrightTexel>& texels, std::size_t count,
               const TexelNeighbours& neighbours)
      : texels_(texels), neighbours_(neighbours) {
    for (std::size_t i = 0; i < count; ++i) {
      const TexelIndex index{texels[i].row, texels[i].column};
      index_by_place_[place(index)] = i;
      if (const int point = neighbours.common_point(index)) by_point_[point].push_back(index);
    }
  }

  // Ascending.
  std::vector<std::size_t> region_of_first() {
    visit({texels_[0].row, texels_[0].column});
    for (std::size_t next = 0; next < region_.size(); ++next) {
      const BrightTexel& texel = texels_[region_[next]];
      const TexelIndex index{texel.row, texel.column};
      for (const TexelIndex& neighbour : neighbours_.of(index)) visit(neighbour);
      // Once, however many of them there are.
      const auto point = by_point_.extract(neighbours_.common_point(index));
      if (point.empty()) continue;
      for (const TexelIndex& neighbour : point.mapped()) visit(neighbour);
    }
    std::ranges::sort(region_);
    return std::move(region_);
  }

 private:
  static std::int64_t place(const TexelIndex& index) {
    return (std::int64_t{index.row} << 32) + index.column;
  }

  void visit(const TexelIndex& index) {
    const auto found = index_by_place_.extract(place(index));
    if (!found.empty()) region_.push_back(found.mapped());
  }

  const std::vector<BrightTexel>& texels_;
  const TexelNeighbours& neighbours_;
  std::unordered_map<std::int64_t, std::size_t> index_by_place_;  // those not visited
  std::unordered_map<int, std::vector<TexelIndex>> by_point_;  // those that touch in one direction
  std::vector<std::size_t> region_;
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

// Of a texel's light in the mean over the sun's: its flux above the level in the largest channel,
// which no colour space changes and which is above 0.
double weight(const BrightTexel& texel, const Texel& place, double level) {
  return place.solid_angle * (texel.value() - level);
}

// The mean of texel_spread() about the sun's direction.
double spread(const BrightestTexels& bright, const FoundSun& found, const TexelPlaces& places) {
  double sum = 0.0;
  double weights = 0.0;
  for (const std::size_t i : found.members) {
    const BrightTexel& texel = bright.texels[i];
    const Texel place = places.texel(texel.row, texel.column);
    const double own = weight(texel, place, found.sun.level);
    sum += own * texel_spread(place.direction, found.sun.direction, place.solid_angle);
    weights += own;
  }
  return sum / weights;
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
  found.members = RegionSearch(texels, count, places.neighbours).region_of_first();
  Sun& sun = found.sun;
  sun.level = level;
  sun.texel_count = static_cast<std::int64_t>(found.members.size());
  glm::dvec3 centroid(0.0);
  glm::dmat3 flux_by_axis(0.0);  // column k: flux times component k of the direction
  for (const std::size_t i : found.members) {
    const Texel texel = places.texel(texels[i].row, texels[i].column);
    const glm::dvec3 flux = texel.solid_angle * (vector_of(texels[i].samples) -
                                                 vector_of(lowered(texels[i], level).samples));
    sun.solid_angle += texel.solid_angle;
    sun.flux += flux;
    centroid += weight(texels[i], texel, level) * texel.direction;
    for (int axis = 0; axis < 3; ++axis) flux_by_axis[axis] += flux * texel.direction[axis];
  }
  sun.direction = glm::normalize(centroid);
  sun.irradiance = flux_by_axis * sun.direction;
  sun.angular_radius = disk_radius(spread(bright, found, places));
  return found;
}

}  // namespace shoal
