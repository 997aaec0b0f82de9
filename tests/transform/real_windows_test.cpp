// Automatic windows of every real panorama.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sphere/automatic_window.h"
#include "sphere/degree_window.h"
#include "sphere/equirect_evaluator.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"
#include "support/test_data.h"
#include "transform/projector.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolders[] = {"pmndrs_hdr",
                                    "pmndrs_exr",
                                    "blender_exr",
                                    "polyhaven_hdr",
                                    "polyhaven_exr",
                                    "rgbe_variants",
                                    "openexr-images/MultiResolution"};
// Not of the whole sphere in colour: a mirror ball's picture, and colours that name a file's
// levels.
constexpr const char* kNoPanoramas[] = {"WavyLinesSphere.exr", "ColorCodedLevels.exr"};

std::vector<fs::path> real_panoramas() {
  std::vector<fs::path> panoramas;
  for (const char* folder : kFolders) {
    for (const auto& entry : fs::directory_iterator(test::data_folder() / folder)) {
      const fs::path& path = entry.path();
      const bool picture = path.extension() == ".hdr" || path.extension() == ".exr";
      if (picture && std::ranges::find(kNoPanoramas, path.filename()) == std::end(kNoPanoramas)) {
        panoramas.push_back(path);
      }
    }
  }
  return panoramas;
}

Coefficients project(const fs::path& path, int degree) {
  ProjectionSettings settings;
  settings.degree = degree;
  ProjectionTables tables;
  auto result = project_panorama(path, {}, settings, tables);
  EXPECT_TRUE(result) << path << ": " << result.error().text();
  return result ? result->radiance : Coefficients(degree);
}

// The least irradiance in 224 x 448 = 10^5 directions, each channel by its mean.
double least_of_many(const Coefficients& radiance) {
  constexpr int kRows = 224;
  const Coefficients irradiance = apply_quantity(radiance, Quantity::irradiance);
  const EquirectEvaluator directions(radiance.degree, 2 * kRows, kRows);
  std::vector<double> row(2 * kRows);
  double least = 1.0;
  for (const auto& channel : irradiance.channels) {
    const double mean = channel[0] / std::sqrt(4 * std::numbers::pi);
    for (int i = 0; mean > 0.0 && i < kRows; ++i) {
      directions.evaluate(channel, i, row);
      least = std::min(least, *std::ranges::min_element(row) / mean);
    }
  }
  return least;
}

// No direction is negative, and the degree that is cut most is not cut any more than it must be:
// with 1 % more of it some direction is. The bound, far below any dip that can be seen, is far
// above the 1e-12 to which the least irradiance is found.
TEST(RealWindows, AreTightAndLeaveNothingNegative) {
  for (const char* folder : kFolders) SHOAL_REQUIRE_TEST_DATA(folder);
  const std::vector<fs::path> panoramas = real_panoramas();
  ASSERT_GE(panoramas.size(), 30U);
  int cut = 0;
  for (const fs::path& path : panoramas) {
    const Coefficients whole = project(path, 32);
    for (const int degree : {1, 2, 3, 4, 6, 8, 16, 32}) {
      SCOPED_TRACE(path.string() + ", degree " + std::to_string(degree));
      const Coefficients light = truncate(whole, degree);
      const auto window = fit_window(light);
      ASSERT_TRUE(window) << window.error().text();
      EXPECT_GE(least_of_many(apply_gains(light, window->gains)), -1e-6);
      const int strongest = window->strongest_cut();
      if (strongest == 0) continue;
      ++cut;
      std::vector<double> raised = window->gains;
      raised[strongest] = raised[strongest] > 0.0 ? 1.01 * raised[strongest] : 0.01;
      EXPECT_LT(least_irradiance(apply_gains(light, raised))->value, -2e-9);
    }
  }
  EXPECT_GE(cut, 20) << "windows that cut nothing show nothing";
  RecordProperty("cut", cut);
}

}  // namespace
}  // namespace shoal
