// What the tests of bright texels and of suns share.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "transform/projector.h"

namespace shoal::test {

constexpr double kPi = std::numbers::pi;

class BrightLight : public testing::Test {
 protected:
  std::filesystem::path write(const Picture& picture, const std::string& name,
                              MapFormat format = MapFormat::exr_float) {
    const auto path = folder_ / (name + (format == MapFormat::hdr ? ".hdr" : ".exr"));
    write_picture(picture, format, path);
    return path;
  }

  static Projection project(const std::filesystem::path& path, const ProjectionSettings& settings,
                            const ReadOptions& options = {}, int threads = 1) {
    ProjectionTables tables;
    auto projection = PanoramaProjection::open(path, options, settings, tables);
    EXPECT_TRUE(projection) << projection.error().text();
    const std::atomic<bool> stop{false};
    std::atomic<std::int64_t> pixels{0};
    {
      std::vector<std::jthread> workers;
      for (int t = 0; t < threads; ++t) {
        workers.emplace_back([&] { EXPECT_TRUE((*projection)->work(stop, pixels)); });
      }
    }
    auto result = (*projection)->finish();
    EXPECT_TRUE(result) << result.error().text();
    return result ? std::move(result).value() : Projection{};
  }

  TemporaryFolder folder_;
};

inline ProjectionSettings clamp_at(double percentile, int degree = 2) {
  ProjectionSettings settings;
  settings.degree = degree;
  settings.pixels.clamp_percentile = percentile;
  return settings;
}

inline ProjectionSettings sun_of(const SunSettings& sun, int degree = 3) {
  ProjectionSettings settings;
  settings.degree = degree;
  settings.sun = sun;
  return settings;
}

inline bool same(const Projection& a, const Projection& b) {
  return a.radiance == b.radiance && a.sun == b.sun && a.warnings == b.warnings &&
         a.pixels.clamp_threshold == b.pixels.clamp_threshold &&
         a.pixels.clamped_flux == b.pixels.clamped_flux &&
         a.pixels.clamped_count == b.pixels.clamped_count &&
         a.pixels.clamp_colour_shift == b.pixels.clamp_colour_shift;
}

// The largest difference of two lots of coefficients, over sqrt(4 pi) times a radiance.
inline double difference(const Coefficients& a, const Coefficients& b) {
  double most = 0.0;
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
      most = std::max(most, std::abs(a.channels[c][i] - b.channels[c][i]));
    }
  }
  return most;
}

}  // namespace shoal::test
