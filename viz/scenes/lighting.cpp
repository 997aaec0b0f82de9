#include "scenes/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "sphere/irradiance.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kEverywhere = 2.0;  // more than a sine: no surface has all of it before it

// What a cell on the horizon gives: nothing from behind, whichever sign its light has.
glm::dvec3 of_one_light(const glm::dvec3& irradiance, const glm::dvec3& facing) {
  glm::dvec3 sum;
  for (int c = 0; c < 3; ++c) {
    sum[c] = facing[c] < 0.0 ? std::min(0.0, irradiance[c]) : std::max(0.0, irradiance[c]);
  }
  return sum;
}

}  // namespace

glm::dmat4 quadratic_form(std::span<const double> radiance) {
  const double y0 = 0.5 * std::sqrt(1.0 / kPi) * clamped_cosine_gain(0);
  const double y1 = 0.5 * std::sqrt(3.0 / kPi) * clamped_cosine_gain(1);
  const double y2 = 0.5 * std::sqrt(15.0 / kPi) * clamped_cosine_gain(2);
  const double y20 = 0.25 * std::sqrt(5.0 / kPi) * clamped_cosine_gain(2);
  const auto c = [&](int l, int m) { return radiance[coefficient_index(l, m)]; };
  glm::dmat4 form(0.0);
  form[0][0] = 0.5 * y2 * c(2, 2);
  form[1][1] = -0.5 * y2 * c(2, 2);
  form[2][2] = 3.0 * y20 * c(2, 0);
  form[0][1] = form[1][0] = 0.5 * y2 * c(2, -2);
  form[1][2] = form[2][1] = 0.5 * y2 * c(2, -1);
  form[0][2] = form[2][0] = 0.5 * y2 * c(2, 1);
  form[0][3] = form[3][0] = 0.5 * y1 * c(1, 1);
  form[1][3] = form[3][1] = 0.5 * y1 * c(1, -1);
  form[2][3] = form[3][2] = 0.5 * y1 * c(1, 0);
  form[3][3] = y0 * c(0, 0) - y20 * c(2, 0);
  return form;
}

IrradianceForm::IrradianceForm(const Coefficients& radiance) {
  for (int c = 0; c < kChannelCount; ++c) {
    std::vector<double> nine = radiance.channels[c];
    nine.resize(coefficient_count(2), 0.0);
    forms_[c] = quadratic_form(nine);
  }
}

glm::dvec3 IrradianceForm::irradiance(const glm::dvec3& normal) const {
  const glm::dvec4 n(normal, 1.0);
  return {glm::dot(n, forms_[0] * n), glm::dot(n, forms_[1] * n), glm::dot(n, forms_[2] * n)};
}

TexelLight::TexelLight(const Pixels& pixels, const glm::dmat3& to_normals) {
  constexpr int kTopWidth = 16;
  levels_.push_back(cells_of(pixels, to_normals));
  while (levels_.back().width > kTopWidth) levels_.push_back(coarser(levels_.back()));
}

TexelLight::Level TexelLight::cells_of(const Pixels& pixels, const glm::dmat3& to_normals) {
  constexpr int kMostCells = 256;  // around
  Level level{std::min(pixels.width, kMostCells), std::min(pixels.height, kMostCells / 2), {}};
  level.blocks.resize(std::size_t(level.width) * level.height);
  for (int i = 0; i < pixels.height; ++i) {
    const double theta = kPi * (i + 0.5) / pixels.height;
    const double belt = std::cos(kPi * i / pixels.height) - std::cos(kPi * (i + 1) / pixels.height);
    const double solid_angle = 2.0 * kPi / pixels.width * belt;
    Block* const row = &level.blocks[std::size_t(i * level.height / pixels.height) * level.width];
    for (int j = 0; j < pixels.width; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / pixels.width;
      const glm::dvec3 direction =
          to_normals * glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
      const float* texel = pixels.at(i, j);
      Block& cell = row[j * level.width / pixels.width];
      cell.center += direction;
      for (int c = 0; c < 3; ++c) cell.flux[c] += solid_angle * texel[c] * direction;
    }
  }
  // From the middle of a cell to its corner, and a little for cells of unlike numbers of texels.
  const double side = std::max(kPi / level.height, 2.0 * kPi / level.width);
  for (Block& cell : level.blocks) {
    cell.center = glm::normalize(cell.center);
    cell.reach = std::sin(std::min(0.5 * kPi, side));
  }
  return level;
}

TexelLight::Level TexelLight::coarser(const Level& fine) {
  Level level{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  level.blocks.resize(std::size_t(level.width) * level.height);
  const auto parent_of = [&](int row, int column) -> Block& {
    return level.blocks[std::size_t(row / 2) * level.width + column / 2];
  };
  const auto each = [&](const auto& use) {
    for (int i = 0; i < fine.height; ++i) {
      for (int j = 0; j < fine.width; ++j) {
        use(fine.blocks[std::size_t(i) * fine.width + j], parent_of(i, j));
      }
    }
  };
  each([](const Block& block, Block& parent) {
    parent.center += block.center;
    parent.flux += block.flux;
  });
  for (Block& block : level.blocks) block.center = glm::normalize(block.center);
  each([](const Block& block, Block& parent) {
    const double between = std::acos(std::min(1.0, glm::dot(block.center, parent.center)));
    const double angle = between + std::asin(std::min(1.0, block.reach));
    parent.reach = std::max(parent.reach, angle < 0.5 * kPi ? std::sin(angle) : kEverywhere);
  });
  return level;
}

void TexelLight::add(std::size_t level, int row, int column, const glm::dvec3& normal,
                     glm::dvec3& sum) const {
  const Level& of = levels_[level];
  if (row >= of.height || column >= of.width) return;
  const Block& block = of.blocks[std::size_t(row) * of.width + column];
  const double cosine = glm::dot(block.center, normal);
  if (cosine <= -block.reach) return;
  if (cosine >= block.reach) {
    sum += normal * block.flux;
    return;
  }
  if (level == 0) {
    sum += of_one_light(normal * block.flux, block.center * block.flux);
    return;
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) add(level - 1, 2 * row + i, 2 * column + j, normal, sum);
  }
}

glm::dvec3 TexelLight::irradiance(const glm::dvec3& normal) const {
  glm::dvec3 sum(0.0);
  const Level& top = levels_.back();
  for (int i = 0; i < top.height; ++i) {
    for (int j = 0; j < top.width; ++j) add(levels_.size() - 1, i, j, normal, sum);
  }
  return sum;
}

}  // namespace shoal::viz
