// OpenEXR's own environment maps: one scene as LATLONG and as CUBE.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/row_moments.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"
#include "transform/projector.h"
#include "transform/simd_codecs.h"

namespace shoal {
namespace {

Coefficients project(const std::filesystem::path& path, Layout layout = Layout::equirect) {
  ProjectionSettings settings;
  settings.layout = layout;
  ProjectionTables tables;
  auto result = project_panorama(path, {}, settings, tables);
  EXPECT_TRUE(result) << result.error().text();
  return result ? result->radiance : Coefficients(2);
}

// Over the 27 numbers.
double relative_difference(const Coefficients& a, const Coefficients& b) {
  double difference = 0.0, norm = 0.0;
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = 0; i < 9; ++i) {
      difference += std::pow(a.channels[c][i] - b.channels[c][i], 2);
      norm += std::pow(a.channels[c][i], 2);
    }
  }
  return std::sqrt(difference / norm);
}

std::filesystem::path map_of(const std::string& name) {
  return test::data_folder() / "openexr-images/MultiResolution" / (name + ".exr");
}

// The tolerances are what the maps' own resampling leaves, and what the wrong rule exceeds.
TEST(EnvironmentMaps, CubeAndLatLongAgreeByTheBorderRule) {
  SHOAL_REQUIRE_TEST_DATA("openexr-images/MultiResolution");
  EXPECT_LT(
      relative_difference(project(map_of("WavyLinesLatLong")), project(map_of("WavyLinesCube"))),
      2e-4);
  EXPECT_LT(relative_difference(project(map_of("OrientationLatLong")),
                                project(map_of("OrientationCube"))),
            1e-3);
}

// The picture alone, without the attribute that says how it lies.
test::Picture pixels_of(const std::filesystem::path& path) {
  const auto source = open_panorama(path, {}, simd_chunk_codecs());
  EXPECT_TRUE(source);
  const PictureInfo& info = (*source)->info();
  test::Picture picture(info.width, info.height);
  auto reader = (*source)->new_reader();
  kernels::RowMomentScratch scratch;
  for (int index = 0; index < info.band_count; ++index) {
    const auto band = (*reader)->read(index);
    EXPECT_TRUE(band);
    for (int row = 0; row < band->row_count(); ++row) {
      for (int c = 0; c < 3; ++c) {
        kernels::widen_row(*band, row, info.channel_count == 1 ? 0 : c, scratch,
                           &picture.at(c, band->row_begin + row, 0));
      }
    }
  }
  return picture;
}

// Taken for ordinary pictures, whose texels lie half a texel away from the border, the two miss
// each other by fifty times as much. OpenEXR's faces are those of OpenGL with z turned round: with
// the last two exchanged they are a vertical strip whose front is behind, (-1)^m in every
// coefficient.
TEST(EnvironmentMaps, TheHalfTexelRuleMissesThem) {
  SHOAL_REQUIRE_TEST_DATA("openexr-images/MultiResolution");
  const test::TemporaryFolder folder;
  test::write_picture(pixels_of(map_of("WavyLinesLatLong")), MapFormat::exr_float,
                      folder / "latlong.exr");
  const test::Picture cube = pixels_of(map_of("WavyLinesCube"));
  const int edge = cube.width;
  const test::Picture strip = test::make_picture(edge, 6 * edge, [&](int c, int row, int column) {
    const int face = row / edge;
    const int from = face < 4 ? face : 9 - face;
    return cube.at(c, from * edge + row % edge, column);
  });
  test::write_picture(strip, MapFormat::exr_float, folder / "strip.exr");
  Coefficients turned = project(folder / "strip.exr", Layout::cube_vertical_strip);
  for (auto& channel : turned.channels) {
    for (int l = 0; l <= 2; ++l) {
      for (int m = -l; m <= l; ++m) channel[coefficient_index(l, m)] *= m % 2 == 0 ? 1.0 : -1.0;
    }
  }
  const double missed = relative_difference(project(folder / "latlong.exr"), turned);
  EXPECT_GT(missed, 5e-3);
  EXPECT_LT(missed, 3e-2);
}

}  // namespace
}  // namespace shoal
