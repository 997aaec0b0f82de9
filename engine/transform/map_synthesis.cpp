#include "transform/map_synthesis.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "sphere/basis.h"
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

glm::dvec3 cube_direction(int face, int size, int row, int column) {
  const double s = 2.0 * (column + 0.5) / size - 1.0;
  const double t = 2.0 * (row + 0.5) / size - 1.0;
  switch (face) {
    case 0:
      return glm::normalize(glm::dvec3(1.0, -t, -s));
    case 1:
      return glm::normalize(glm::dvec3(-1.0, -t, s));
    case 2:
      return glm::normalize(glm::dvec3(s, 1.0, t));
    case 3:
      return glm::normalize(glm::dvec3(s, -1.0, -t));
    case 4:
      return glm::normalize(glm::dvec3(s, -t, 1.0));
    default:
      return glm::normalize(glm::dvec3(-s, -t, -1.0));
  }
}

Status write_equirect_map(const Coefficients& coefficients, const std::filesystem::path& path,
                          const MapFile& file) {
  EquirectSynthesis synthesis(file.width, file.height, coefficients.degree);
  return write_map(path, file, [&](int row, const std::array<float*, kChannelCount>& planes) {
    synthesis.row(coefficients, row, planes);
  });
}

Status write_cube_map(const Coefficients& coefficients, CubePacking packing, int face,
                      const std::filesystem::path& path, const MapFile& file) {
  const int size = file.height;
  const Basis<double> basis(coefficients.degree);
  std::vector<double> values(coefficient_count(coefficients.degree));
  return write_map(path, file, [&](int row, const std::array<float*, kChannelCount>& planes) {
    for (int x = 0; x < file.width; ++x) {
      const int texel_face = packing == CubePacking::strip ? x / size : face;
      basis.evaluate(cube_direction(texel_face, size, row, x % size), values);
      const glm::dvec3 colour = evaluate(coefficients, values);
      for (int c = 0; c < kChannelCount; ++c) planes[c][x] = static_cast<float>(colour[c]);
    }
  });
}

}  // namespace shoal
