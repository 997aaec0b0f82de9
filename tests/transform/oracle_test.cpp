// Real panoramas against coefficients that an independent program computed: float64, brute force
// per pixel, SciPy's harmonics. It stands beside the panoramas, in ../oracle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "support/test_data.h"
#include "transform/projector.h"

namespace shoal {
namespace {

using Key = std::pair<std::string, std::string>;  // file, quadrature
using Table = std::map<Key, Coefficients>;

constexpr int kDegree = 8;

Table read_oracle(const std::filesystem::path& path) {
  Table table;
  std::ifstream stream(path);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    std::array<std::string, 7> field;
    for (auto& text : field) std::getline(fields, text, ',');
    Coefficients& entry = table.try_emplace({field[0], field[1]}, kDegree).first->second;
    const int index = coefficient_index(std::stoi(field[2]), std::stoi(field[3]));
    for (int c = 0; c < 3; ++c) entry.channels[c][index] = std::stod(field[4 + c]);
  }
  return table;
}

Quadrature quadrature_named(const std::string& name) {
  for (const Quadrature q : {Quadrature::texel, Quadrature::midpoint, Quadrature::fejer}) {
    if (name_of(q) == name) return q;
  }
  ADD_FAILURE() << "quadrature " << name;
  return Quadrature::texel;
}

TEST(Oracle, AgreesOnEveryRealPanoramaAndQuadrature) {
  const std::string oracle = "../oracle/coefficients.csv";
  SHOAL_REQUIRE_TEST_DATA(oracle);
  const Table table = read_oracle(test::data_folder() / oracle);
  ASSERT_FALSE(table.empty());
  ProjectionTables tables;
  for (const auto& [key, expected] : table) {
    ProjectionSettings settings;
    settings.degree = kDegree;
    settings.quadrature = quadrature_named(key.second);
    const auto result = project_panorama(test::data_folder() / key.first, {}, settings, tables);
    ASSERT_TRUE(result) << result.error().text();
    for (int c = 0; c < 3; ++c) {
      const double l00 = expected.channels[c][0];
      for (int i = 0; i < coefficient_count(kDegree); ++i) {
        // The kernel's single precision, relative to the light there is.
        EXPECT_NEAR(result->radiance.channels[c][i], expected.channels[c][i], 1e-6 * l00)
            << key.first << " " << key.second << " channel " << c << " index " << i;
      }
    }
  }
}

// At the degrees people use and at the highest; the twin takes a basis function a pixel, so the
// highest degree gets a small picture. Per coefficient the bound of projector.h is tested on made
// pictures; here it is relative to the light there is.
TEST(Oracle, TheTwinAgreesOnRealPanoramas) {
  SHOAL_REQUIRE_TEST_DATA("pmndrs_hdr");
  SHOAL_REQUIRE_TEST_DATA("pmndrs_exr");
  ProjectionTables tables;
  for (const auto& [file, degree] : {std::pair{"pmndrs_hdr/venice.hdr", 2},
                                     {"pmndrs_hdr/sunset.hdr", 10},
                                     {"pmndrs_exr/venice.exr", 64}}) {
    ProjectionSettings settings;
    settings.degree = degree;
    const auto fast = project_panorama(test::data_folder() / file, {}, settings, tables);
    settings.arithmetic = Arithmetic::reference;
    const auto slow = project_panorama(test::data_folder() / file, {}, settings, tables);
    ASSERT_TRUE(fast) << fast.error().text();
    ASSERT_TRUE(slow) << slow.error().text();
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < coefficient_count(degree); ++i) {
        EXPECT_NEAR(fast->radiance.channels[c][i], slow->radiance.channels[c][i],
                    1e-6 * slow->radiance.channels[c][0])
            << "degree " << degree << " index " << i;
      }
    }
  }
}

}  // namespace
}  // namespace shoal
