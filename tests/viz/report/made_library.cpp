#include "made_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "sphere/basis.h"
#include "support/random_numbers.h"

namespace shoal::viz::test {
namespace {

// A sky that darkens downwards, a ground, and a sun of some width, or a coloured lamp.
struct Light {
  glm::dvec3 zenith, horizon, ground, sun, sun_direction;
  double sharpness;

  explicit Light(std::size_t number) {
    shoal::test::RandomNumbers random(number);
    const double brightness = std::exp2(random.between(-4.0, 3.0));
    zenith = brightness * glm::dvec3(random.between(0.1, 0.4), random.between(0.3, 0.6), 1.0);
    horizon = brightness * glm::dvec3(1.0, random.between(0.7, 1.0), random.between(0.5, 1.0));
    ground = brightness * random.between(0.05, 0.4) * glm::dvec3(1.0, 0.8, 0.6);
    sharpness = std::exp2(random.between(1.0, 7.0));
    sun = brightness * sharpness * random.between(0.0, 1.0) * glm::dvec3(1.0, 0.85, 0.65);
    if (number % 5 == 4) sun *= glm::dvec3(1.0, 0.2, 0.1);
    const double elevation = random.between(-0.2, 1.4);
    const double phi = random.between(0.0, 2.0 * std::numbers::pi);
    sun_direction = {std::cos(elevation) * std::cos(phi), std::cos(elevation) * std::sin(phi),
                     std::sin(elevation)};
  }

  [[nodiscard]] glm::dvec3 towards(const glm::dvec3& direction) const {
    const glm::dvec3 around =
        direction.z > 0.0 ? glm::mix(horizon, zenith, std::sqrt(direction.z))
                          : glm::mix(0.5 * horizon, ground, std::min(1.0, -8.0 * direction.z));
    return around + sun * std::exp(sharpness * (glm::dot(direction, sun_direction) - 1.0));
  }
};

glm::dvec3 texel_direction(int row, int column, int height) {
  const double theta = std::numbers::pi * (row + 0.5) / height;
  const double phi = std::numbers::pi * (column + 0.5) / height;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Coefficients projected(const Light& light, int degree) {
  constexpr int kHeight = 32;
  const Basis<double> basis(degree);
  std::vector<double> values(coefficient_count(degree));
  Coefficients out(degree);
  for (int row = 0; row < kHeight; ++row) {
    const double area = (std::cos(std::numbers::pi * row / kHeight) -
                         std::cos(std::numbers::pi * (row + 1) / kHeight)) *
                        std::numbers::pi / kHeight;
    for (int column = 0; column < 2 * kHeight; ++column) {
      const glm::dvec3 direction = texel_direction(row, column, kHeight);
      const glm::dvec3 radiance = area * light.towards(direction);
      basis.evaluate(direction, values);
      for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < values.size(); ++i)
          out.channels[c][i] += radiance[c] * values[i];
      }
    }
  }
  return out;
}

PixelFigures made_figures(std::size_t number) {
  PixelFigures figures;
  figures.format = number % 2 == 0 ? "Radiance RGBE" : "OpenEXR half, ZIP";
  figures.height = 512 << number % 3;
  figures.width = 2 * figures.height;
  figures.pixel_count = std::int64_t{1} * figures.width * figures.height;
  figures.clamped_count = number % 7 == 3 ? 12 : 0;
  const Pixels pixels = made_pixels(number, 32);
  figures.minimum = figures.maximum = {pixels.rgb[0], pixels.rgb[1], pixels.rgb[2]};
  for (std::size_t i = 0; i < pixels.rgb.size(); ++i) {
    figures.minimum[i % 3] = std::min<double>(figures.minimum[i % 3], pixels.rgb[i]);
    figures.maximum[i % 3] = std::max<double>(figures.maximum[i % 3], pixels.rgb[i]);
    figures.mean[i % 3] += 3.0 * pixels.rgb[i] / static_cast<double>(pixels.rgb.size());
  }
  return figures;
}

QualityFigures made_quality(std::size_t number) {
  const auto n = static_cast<double>(number);
  return {.rms_error = 0.001 * (1.0 + n),
          .max_error = 0.004 * (1.0 + n),
          .minimum_irradiance = 0.2 - 0.01 * n,
          .negative_fraction = number > 20 ? 0.01 : 0.0,
          .contrast = 0.9 - 0.01 * n,
          .directionality = 0.3 + 0.01 * n,
          .key_temperature = 4500.0 + 100.0 * n,
          .fill_temperature = 7000.0};
}

}  // namespace

Library made_library(std::size_t count, int degree) {
  Library library;
  library.title = "Made skies";
  for (std::size_t i = 0; i < count; ++i) {
    Panorama panorama;
    panorama.name = fmt::format("sky_{:04}", i);
    if (i % 6 == 5) panorama.variant = "warm";
    panorama.file = panorama.name + ".hdr";
    panorama.coefficients = projected(Light(i), degree);
    panorama.pixels = made_figures(i);
    if (i % 4 != 3) panorama.quality = made_quality(i);
    panorama.tags = {panorama.coefficients.channels[1][0] > 2.0 ? "clear" : "dim"};
    if (i % 5 == 4) panorama.tags.push_back("red");
    if (i % 4 == 3) panorama.warnings.push_back("12 pixels above 65504 were clamped");
    library.panoramas.push_back(std::move(panorama));
  }
  return library;
}

Pixels made_pixels(std::size_t panorama, int width) {
  const Light light(panorama);
  Pixels pixels{width, width / 2, {}};
  for (int row = 0; row < pixels.height; ++row) {
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 radiance = light.towards(texel_direction(row, column, pixels.height));
      for (int c = 0; c < 3; ++c) pixels.rgb.push_back(static_cast<float>(radiance[c]));
    }
  }
  return pixels;
}

PictureSource MadePictures::source() {
  return {[](std::span<const std::size_t>, int) {},
          [this](std::size_t panorama, int width) -> const Pixels& {
            pixels_ = made_pixels(panorama, width);
            return pixels_;
          },
          [](std::size_t) { return std::string(); }};
}

PictureSource no_pictures(const std::string& why) {
  return {[](std::span<const std::size_t>, int) {},
          [](std::size_t, int) -> const Pixels& {
            static const Pixels none;
            return none;
          },
          [why](std::size_t) { return why; }};
}

std::vector<std::string> hostile_names() {
  return {"</script><script>document.title='broken'</script>",
          "<img src=x onerror=alert(1)>",
          "quotes \" ' ` and \\ and ${1}",
          "line\nfeed\r and tab\t and \x01 control",
          "not UTF-8 \xFF\xC3( end",
          "\xE2\x80\xA8 line separator \xE2\x80\xA9",
          "<!-- <script> comment",
          "comma, in a name",
          "ends a comment */ ]]> \\"};
}

}  // namespace shoal::viz::test
