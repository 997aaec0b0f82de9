#include "transform/layout_preview.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "sphere/layout_places.h"
#include "sphere/texel_geometry.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 3;                // a side of a texel of the preview
constexpr int kTexelsPerPreviewTexel = 2;  // of the smaller picture, along a side

bool is_disc(Layout layout) { return layout == Layout::angular || layout == Layout::mirror_ball; }

// How many times a square's edge goes all around the sphere.
int edges_around(Layout layout) {
  if (is_cube(layout)) return 4;
  return is_disc(layout) ? 1 : 2;
}

// The shares of `blocks` squares one after the other, each of `cells` made into `small`.
SmallAxis axis_of(int blocks, int texels, int small, Sampling sampling) {
  SmallAxis axis;
  axis.count = blocks * small;
  const std::vector<AreaShare> block = column_shares(texels, small, sampling);
  for (int i = 0; i < blocks; ++i) {
    for (AreaShare share : block) {
      share.first += i * small;
      axis.shares.push_back(share);
    }
  }
  return axis;
}

// Looks directions up in a picture of a layout.
class Lookup {
 public:
  Lookup(const SmallPicture& picture, Layout layout, int edge)
      : picture_(picture),
        places_(layout),
        edge_(edge),
        reach_(is_disc(layout) ? 0.5 - 0.5 / edge : 1.0) {}

  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& direction) const {
    LayoutPlace place = places_.of(direction);
    keep_within_reach(place);
    const Along rows = along(place.down, place.block_row);
    const Along columns = along(place.right, place.block_column);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        const auto texel =
            static_cast<std::size_t>(rows.texel[i]) * picture_.width + columns.texel[j];
        if (picture_.has_light[texel] == 0) continue;
        const double weight = rows.weight[i] * columns.weight[j];
        for (int c = 0; c < 3; ++c) sum[c] += weight * picture_.planes[c][texel];
        weights += weight;
      }
    }
    return weights > 0.0 ? sum / weights : glm::dvec3(0.0);
  }

 private:
  // The two texels that are nearest along an axis.
  struct Along {
    std::array<int, 2> texel;
    std::array<double, 2> weight;
  };

  [[nodiscard]] Along along(double place, int block) const {
    const double texels = std::clamp(place * edge_ - 0.5, 0.0, edge_ - 1.0);
    const int first = std::min(static_cast<int>(texels), std::max(0, edge_ - 2));
    const int behind = std::min(first + 1, edge_ - 1);
    const double way = texels - first;
    return {{block * edge_ + first, block * edge_ + behind}, {1.0 - way, way}};
  }

  // Of a disc's texels those count whose centre is on it.
  void keep_within_reach(LayoutPlace& place) const {
    const double radius = std::hypot(place.right - 0.5, place.down - 0.5);
    if (radius <= reach_) return;
    place.right = 0.5 + (place.right - 0.5) * reach_ / radius;
    place.down = 0.5 + (place.down - 0.5) * reach_ / radius;
  }

  const SmallPicture& picture_;
  LayoutPlaces places_;
  int edge_;
  double reach_;  // from the middle of a square
};

// The place of a sample among all that go from 0 to `range`.
double sample_angle(int texel, int sample, int texel_count, double range) {
  return range * (texel * kSamples + sample + 0.5) / (texel_count * kSamples);
}

glm::dvec3 mean_of_texel(const Lookup& lookup, int row, int column, const SmallPicture& preview) {
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double theta = sample_angle(row, i, preview.height, kPi);
    const double sine = std::sin(theta);
    const double cosine = std::cos(theta);
    weights += sine * kSamples;
    for (int j = 0; j < kSamples; ++j) {
      const double phi = sample_angle(column, j, preview.width, 2.0 * kPi);
      sum += sine * lookup({sine * std::cos(phi), sine * std::sin(phi), cosine});
    }
  }
  return sum / weights;
}

Result<SmallPicture> resample(const SmallPicture& picture, Layout layout, int edge, int width,
                              const std::atomic<bool>& stop) {
  const Lookup lookup(picture, layout, edge);
  SmallPicture preview;
  preview.width = width;
  preview.height = (width + 1) / 2;
  for (int row = 0; row < preview.height; ++row) {
    if (stop) return Error{ErrorCode::interrupted, "interrupted", "", ""};
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 colour = mean_of_texel(lookup, row, column, preview);
      for (int c = 0; c < 3; ++c) preview.planes[c].push_back(static_cast<float>(colour[c]));
    }
  }
  preview.has_light.assign(preview.planes[0].size(), 1);
  return preview;
}

}  // namespace

Result<SmallPicture> layout_preview(const LaidOutPicture& picture, int width,
                                    const std::atomic<bool>& stop) {
  const PictureInfo& info = picture.source->info();
  auto geometry = TexelGeometry::create(picture.layout, info.width, info.height);
  if (!geometry) {
    geometry.error().where = picture.files.front().string();
    return std::move(geometry).error();
  }
  const LayoutSize blocks = size_of(picture.layout, 1);
  const int texels = info.width / blocks.width;
  // Cells between texels that lie on a face's edges are one less.
  const bool on_edges = picture.layout == Layout::cube_openexr && texels > 1;
  const int cells = on_edges ? texels - 1 : texels;
  const Sampling sampling = on_edges ? Sampling::endpoints : Sampling::centers;
  const int around = edges_around(picture.layout);
  const int small_width =
      static_cast<int>(std::min<std::int64_t>(width, std::int64_t{around} * cells));
  const int edge = std::min(cells, (kTexelsPerPreviewTexel * small_width + around - 1) / around);
  SHOAL_ASSIGN_OR_RETURN(small,
                         shrink(*picture.source, axis_of(blocks.height, texels, edge, sampling),
                                axis_of(blocks.width, texels, edge, sampling), &*geometry, stop));
  return resample(small, picture.layout, edge, small_width, stop);
}

}  // namespace shoal
