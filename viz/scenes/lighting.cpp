#include "scenes/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "sphere/irradiance.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

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
  for (int i = 0; i < pixels.height; ++i) {
    const double theta = kPi * (i + 0.5) / pixels.height;
    const double belt = std::cos(kPi * i / pixels.height) - std::cos(kPi * (i + 1) / pixels.height);
    const double solid_angle = 2.0 * kPi / pixels.width * belt;
    for (int j = 0; j < pixels.width; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / pixels.width;
      const float* texel = pixels.at(i, j);
      directions_.push_back(to_normals * glm::dvec3(std::sin(theta) * std::cos(phi),
                                                    std::sin(theta) * std::sin(phi),
                                                    std::cos(theta)));
      flux_.push_back(solid_angle * glm::dvec3(texel[0], texel[1], texel[2]));
    }
  }
}

glm::dvec3 TexelLight::irradiance(const glm::dvec3& normal) const {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    sum += std::max(0.0, glm::dot(directions_[i], normal)) * flux_[i];
  }
  return sum;
}

}  // namespace shoal::viz
