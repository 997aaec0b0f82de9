#include "transform/map_synthesis.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "sphere/basis.h"
#include "sphere/rotation.h"
#include "sphere/texel_geometry.h"
#include "transform/projection_tables.h"

namespace shoal {
namespace {

// Rows of a picture are handed to its writer in blocks of this many.
constexpr int kRowsAtOnce = 16;

// Writes a map whose rows `fill(row, planes)` makes.
template <typename Fill>
Status write_map(const std::filesystem::path& path, const MapFile& file, const Fill& fill) {
  SHOAL_ASSIGN_OR_RETURN(writer, MapWriter::create(path, file));
  const auto width = static_cast<std::size_t>(file.width);
  std::vector<float> samples(kChannelCount * kRowsAtOnce * width);
  std::array<float*, kChannelCount> planes;
  for (int c = 0; c < kChannelCount; ++c) planes[c] = samples.data() + c * kRowsAtOnce * width;
  for (int first = 0; first < file.height; first += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, file.height - first);
    for (int i = 0; i < count; ++i) {
      fill(first + i, {planes[0] + i * width, planes[1] + i * width, planes[2] + i * width});
    }
    SHOAL_RETURN_IF_ERROR(writer->write_rows({planes[0], planes[1], planes[2]},
                                             static_cast<std::ptrdiff_t>(width), count));
  }
  return writer->commit();
}

}  // namespace

EquirectSynthesis::EquirectSynthesis(int width, int height, int degree)
    : height_(height),
      legendre_(degree),
      polar_(legendre_count(degree)),
      moments_(2 * degree + 1),
      plan_(kernels::make_row_moment_plan(width, degree,
                                          column_phases({width, height, Sampling::centers}))) {}

void EquirectSynthesis::row(const Coefficients& coefficients, int row,
                            const std::array<float*, kChannelCount>& planes) {
  const int degree = legendre_.degree();
  const double theta = std::numbers::pi * (row + 0.5) / height_;
  legendre_.evaluate(std::cos(theta), std::sin(theta), polar_);
  for (int c = 0; c < kChannelCount; ++c) {
    const auto& channel = coefficients.channels[c];
    for (int m = 0; m <= degree; ++m) {
      double cosine = 0.0;
      double sine = 0.0;
      for (int l = m; l <= degree; ++l) {
        const double polar = polar_[legendre_index(l, m)];
        cosine += channel[coefficient_index(l, m)] * polar;
        sine += channel[coefficient_index(l, -m)] * polar;
      }
      moments_[m] = cosine;
      if (m > 0) moments_[degree + m] = sine;
    }
    kernels::synthesise_row(plan_, moments_, scratch_, planes[c]);
  }
}

Status write_equirect_map(const Coefficients& coefficients, const std::filesystem::path& path,
                          const MapFile& file) {
  EquirectSynthesis synthesis(file.width, file.height, coefficients.degree);
  return write_map(path, file, [&](int row, const std::array<float*, kChannelCount>& planes) {
    synthesis.row(coefficients, row, planes);
  });
}

Coefficients facing(const Coefficients& native, const Frame& frame) {
  return rotate(native, glm::transpose(native_to_frame(cube_frame())) * native_to_frame(frame));
}

Status write_layout_map(const Coefficients& coefficients, Layout layout, int face,
                        const std::filesystem::path& path, const MapFile& file) {
  const bool is_face = layout == Layout::cube_faces;
  const int first_row = is_face ? face * file.height : 0;
  const int height = is_face ? kCubeFaceCount * file.height : file.height;
  auto geometry = TexelGeometry::create(layout, file.width, height);
  if (!geometry) {
    geometry.error().where = path.string();
    return std::move(geometry).error();
  }
  const Basis<double> basis(coefficients.degree);
  std::vector<double> values(coefficient_count(coefficients.degree));
  MapFile told = file;
  if (layout == Layout::cube_openexr) told.environment = MapFile::Environment::cube;
  return write_map(path, told, [&](int row, const std::array<float*, kChannelCount>& planes) {
    for (float* plane : planes) std::fill_n(plane, file.width, 0.0F);
    const int in_picture = first_row + row;
    const TexelSpan span = geometry->span_of({in_picture, 0, 0, 1, file.width});
    for (int x = span.begin; x < span.end; ++x) {
      basis.evaluate(geometry->texel(in_picture, x).direction, values);
      const glm::dvec3 colour = evaluate(coefficients, values);
      for (int c = 0; c < kChannelCount; ++c) planes[c][x] = static_cast<float>(colour[c]);
    }
  });
}

}  // namespace shoal
