// Made-up projections and items, for the tests of the store.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "batch/sqlite.h"
#include "batch/store.h"

namespace shoal::test {

// A projection whose every number follows from `seed`, any bits that are finite among them.
inline Projection some_projection(unsigned seed, int degree) {
  std::mt19937_64 random(seed);
  const auto finite = [&random] {
    double value = 0.0;
    do value = std::bit_cast<double>(random());
    while (!std::isfinite(value));
    return value;
  };
  Projection projection;
  projection.radiance = Coefficients(degree);
  for (auto& channel : projection.radiance.channels) {
    for (double& value : channel) value = finite();
  }
  projection.radiance.channels[0][0] = -0.0;
  projection.grid = {1024 + static_cast<int>(seed), 512, Sampling::endpoints};
  projection.format = "OpenEXR half ZIP";
  projection.quadrature = Quadrature::clenshaw_curtis;
  projection.solid_angle = finite();
  auto& pixels = projection.pixels;
  for (auto* triple : {&pixels.minimum, &pixels.maximum, &pixels.mean, &pixels.clamped_flux}) {
    for (double& value : *triple) value = finite();
  }
  pixels.pixel_count = std::int64_t{1} << 34;
  pixels.nonfinite_count = 1;
  pixels.negative_count = 2;
  pixels.clamped_count = 3;
  pixels.clamp_threshold = finite();
  pixels.clamp_colour_shift = finite();
  if (seed % 2 == 1) {
    Sun sun;
    for (glm::dvec3* vector : {&sun.direction, &sun.irradiance, &sun.flux}) {
      *vector = {finite(), finite(), finite()};
    }
    for (double* value : {&sun.solid_angle, &sun.angular_radius, &sun.level, &sun.share}) {
      *value = finite();
    }
    sun.texel_count = seed;
    projection.sun = sun;
  }
  projection.warnings = {"its EXPOSURE line is garbage", "the second warning"};
  return projection;
}

inline void expect_same_bits(const Coefficients& a, const Coefficients& b) {
  ASSERT_EQ(a.degree, b.degree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a.channels[c][i]),
                std::bit_cast<std::uint64_t>(b.channels[c][i]))
          << "channel " << c << " index " << i;
    }
  }
}

inline ItemRecord some_item(const std::string& name, const Projection* projection) {
  ItemRecord item;
  item.name = name;
  item.state.input_path = "/library/" + name + ".exr";
  item.state.input_hash = "input hash of " + name;
  item.state.parameters = "degree: 2";
  item.state.output_hash = "output hash";
  item.state.algorithm_version = 7;
  item.state.outputs = {
      {"maps/" + name + ".irradiance.exr", "map:irradiance", "hash z", 12},
      {"maps/" + name + ".a.exr", "map:radiance", "hash a", std::uint64_t{1} << 40}};
  item.engine_version = "0.1.0";
  item.timings = {0.25, 0.5, 0.125};
  item.projection = projection;
  return item;
}

inline std::string problems_of(const std::filesystem::path& path) {
  auto database = SqlDatabase::open(path, SqlDatabase::Create::never);
  if (!database) return database.error().text();
  auto check = database->prepare("PRAGMA integrity_check");
  check->start();
  const auto step = check->step();
  if (!step) return step.error().text();
  const std::string verdict = check->text(0);
  auto keys = database->prepare("PRAGMA foreign_key_check");
  keys->start();
  const auto key_step = keys->step();
  if (!key_step || *key_step != SqlStatement::Step::done) return "a foreign key dangles";
  return verdict == "ok" ? "" : verdict;
}

}  // namespace shoal::test
