// A higher degree for figures of quality changes no bit of what the tables hold.
#include <gtest/gtest.h>

#include <cmath>

#include "sphere/linear_operations.h"
#include "support/every_target.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "transform/projector.h"

namespace shoal {
namespace {

class QualityDegree : public testing::Test {
 protected:
  Projection project(const std::filesystem::path& path, const ProjectionSettings& settings) {
    auto projection = project_panorama(path, {}, settings, tables_);
    EXPECT_TRUE(projection) << projection.error().text();
    return projection ? std::move(*projection) : Projection{};
  }

  // Alone, and with a higher degree asked for besides.
  void expect_the_same(const std::filesystem::path& path, ProjectionSettings settings) {
    const Projection alone = project(path, settings);
    EXPECT_FALSE(alone.finer);
    settings.quality_degree = 21;
    const Projection both = project(path, settings);
    EXPECT_EQ(both.radiance, alone.radiance) << settings.degree;
    EXPECT_EQ(both.pixels.mean, alone.pixels.mean);
    EXPECT_EQ(both.pixels.clamped_flux, alone.pixels.clamped_flux);
    EXPECT_EQ(both.solid_angle, alone.solid_angle);
    ASSERT_TRUE(both.finer);
    EXPECT_EQ(both.finer->degree, 21);
    EXPECT_EQ(truncate(*both.finer, settings.degree), alone.radiance);

    // Those above are what a projection to that degree has.
    settings.degree = 21;
    settings.quality_degree = 7;
    const Projection whole = project(path, settings);
    EXPECT_FALSE(whole.finer) << "a lower degree asks for nothing";
    for (int c = 0; c < kChannelCount; ++c) {
      for (std::size_t i = alone.radiance.channels[c].size(); i < both.finer->channels[c].size();
           ++i) {
        EXPECT_EQ(both.finer->channels[c][i], whole.radiance.channels[c][i]);
      }
    }
  }

  test::TemporaryFolder folder_;
  ProjectionTables tables_;
};

// Widths with and without the fold in four, degrees with and without sums in registers, a row that
// is clamped.
TEST_F(QualityDegree, ChangesNoBitOfEquirectPictures) {
  for (const int width : {30, 64, 256, 1031}) {
    test::write_picture(test::make_noisy_picture(width, 33, 7), MapFormat::exr_float,
                        folder_ / "a.exr");
    for (const int degree : {0, 1, 2, 3, 4, 5, 10}) {
      for (const Quadrature quadrature :
           {Quadrature::texel, Quadrature::midpoint, Quadrature::fejer}) {
        ProjectionSettings settings;
        settings.degree = degree;
        settings.quadrature = quadrature;
        settings.pixels.clamp = 1000.0;
        expect_the_same(folder_ / "a.exr", settings);
      }
    }
  }
}

TEST_F(QualityDegree, ChangesNoBitOnAnyTarget) {
  test::write_picture(test::make_noisy_picture(128, 40, 11), MapFormat::hdr, folder_ / "a.hdr");
  test::for_every_target([&] { expect_the_same(folder_ / "a.hdr", {}); });
}

TEST_F(QualityDegree, ChangesNoBitOfTheReference) {
  test::write_picture(test::make_noisy_picture(24, 12, 5), MapFormat::exr_float, folder_ / "a.exr");
  for (const int degree : {0, 2, 5}) {
    ProjectionSettings settings;
    settings.degree = degree;
    settings.arithmetic = Arithmetic::reference;
    expect_the_same(folder_ / "a.exr", settings);
    settings.layout = Layout::octahedral;
    test::write_picture(test::make_noisy_picture(12, 12, 5), MapFormat::exr_float,
                        folder_ / "square.exr");
    expect_the_same(folder_ / "square.exr", settings);
  }
}

TEST_F(QualityDegree, ChangesNoBitOfOtherLayouts) {
  test::write_picture(test::make_noisy_picture(70, 70, 9), MapFormat::exr_float, folder_ / "a.exr");
  for (const Layout layout : {Layout::octahedral, Layout::angular}) {
    for (const int degree : {0, 1, 2, 3, 6}) {
      ProjectionSettings settings;
      settings.degree = degree;
      settings.layout = layout;
      expect_the_same(folder_ / "a.exr", settings);
    }
  }
}

}  // namespace
}  // namespace shoal
