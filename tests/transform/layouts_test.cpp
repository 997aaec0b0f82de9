// One scene in every layout.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <thread>

#include "image/face_files.h"
#include "layout_list.h"
#include "sphere/basis.h"
#include "sphere/texel_geometry.h"
#include "support/every_target.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "transform/layout_source.h"
#include "transform/projector.h"
#include "transform/simd_codecs.h"

namespace shoal {
namespace {

using test::kOneFile;
using test::Picture;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;
constexpr std::string_view kFaceEnds[] = {"px", "nx", "py", "ny", "pz", "nz"};

ProjectionSettings settings_of(Layout layout, int degree = 4,
                               Arithmetic arithmetic = Arithmetic::kernels) {
  ProjectionSettings settings;
  settings.degree = degree;
  settings.layout = layout;
  settings.arithmetic = arithmetic;
  return settings;
}

Result<Projection> try_project(const std::filesystem::path& path,
                               const ProjectionSettings& settings,
                               const ReadOptions& options = {}) {
  ProjectionTables tables;
  return project_panorama(path, options, settings, tables);
}

Projection project(const std::filesystem::path& path, const ProjectionSettings& settings,
                   const ReadOptions& options = {}) {
  auto result = try_project(path, settings, options);
  EXPECT_TRUE(result) << result.error().text();
  return result ? std::move(result).value() : Projection{};
}

// Light of degree 4, positive or nearly so.
Coefficients scene() {
  test::RandomNumbers random(11);
  Coefficients coefficients(4);
  for (auto& channel : coefficients.channels) {
    for (double& value : channel) value = random.between(-0.3, 0.3);
    channel[0] = 4.0;
  }
  return coefficients;
}

// What no reader may look at.
constexpr float kText[] = {1e30F, -5.0F, NAN, INFINITY};

// A picture of the scene; texels that show nothing hold text.
Picture paint(const Coefficients& light, Layout layout, int edge) {
  const LayoutSize size = size_of(layout, edge);
  auto geometry = TexelGeometry::create(layout, size.width, size.height);
  Picture picture(size.width, size.height);
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < picture.planes[c].size(); ++i) {
      picture.planes[c][i] = kText[(i + c) % 4];
    }
  }
  for (int row = 0; row < size.height; ++row) {
    const TexelSpan span = geometry->span_of({row, 0, 0, 1, size.width});
    for (int column = span.begin; column < span.end; ++column) {
      const glm::dvec3 colour = evaluate(light, geometry->texel(row, column).direction);
      for (int c = 0; c < 3; ++c) picture.at(c, row, column) = static_cast<float>(colour[c]);
    }
  }
  return picture;
}

// Relative to the L2 norm of `expected`, over all channels.
double relative_error(const Coefficients& found, const Coefficients& expected) {
  double difference = 0.0, norm = 0.0;
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < expected.channels[c].size(); ++i) {
      difference += std::pow(found.channels[c][i] - expected.channels[c][i], 2);
      norm += std::pow(expected.channels[c][i], 2);
    }
  }
  return std::sqrt(difference / norm);
}

class Layouts : public testing::Test {
 protected:
  std::filesystem::path write(const Picture& picture, const std::string& name,
                              MapFormat format = MapFormat::exr_float) {
    const auto path = folder_ / (name + (format == MapFormat::hdr ? ".hdr" : ".exr"));
    test::write_picture(picture, format, path);
    return path;
  }

  // The faces of a vertical strip as files NAME_px.exr ... NAME_nz.exr; the first one's path.
  std::filesystem::path write_faces(const Picture& strip, const std::string& name) {
    for (int face = 0; face < kFaceCount; ++face) {
      write(test::make_picture(strip.width, strip.width,
                               [&](int c, int row, int column) {
                                 return strip.at(c, face * strip.width + row, column);
                               }),
            name + "_" + std::string(kFaceEnds[face]));
    }
    return folder_ / (name + "_px.exr");
  }

  test::TemporaryFolder folder_;
};

// The midpoint rule on texels: h^2 where texels are alike, h^(3/2) on a mirror ball, whose number
// of texels in the disc is what a lattice has in a circle. Three sizes: the error of the largest is
// 1/16 (1/8) of the smallest, with room for what the lattice does by chance.
TEST_F(Layouts, AgreeWithinAnErrorThatFallsAsTheSizeGrows) {
  const Coefficients light = scene();
  for (const Layout layout : kOneFile) {
    std::vector<double> errors;
    for (const int edge : {16, 32, 64}) {
      const auto path = write(paint(light, layout, edge), "scene");
      const Projection result = project(path, settings_of(layout));
      errors.push_back(relative_error(result.radiance, light));
      EXPECT_EQ(result.quadrature, Quadrature::midpoint);
      EXPECT_THAT(result.format, HasSubstr(name_of(layout)));
      EXPECT_THAT(result.warnings, IsEmpty()) << name_of(layout);
      EXPECT_EQ(result.pixels.nonfinite_count, 0);
      EXPECT_LT(result.pixels.maximum[0], 10.0) << "text was looked at";
    }
    const bool is_ball = layout == Layout::mirror_ball;
    EXPECT_LT(errors[0], is_ball ? 0.15 : 0.02) << name_of(layout);
    EXPECT_LT(errors[2], errors[0] / (is_ball ? 4.0 : 12.0))
        << name_of(layout) << ": " << errors[0] << " " << errors[1] << " " << errors[2];
  }
}

// The same picture as one strip and as six files.
TEST_F(Layouts, SixFilesAreAStrip) {
  const Picture strip = paint(scene(), Layout::cube_vertical_strip, 12);
  const auto path = write(strip, "strip");
  const auto faces = write_faces(strip, "sky");
  const Projection expected = project(path, settings_of(Layout::cube_vertical_strip));
  const Projection result = project(faces, settings_of(Layout::cube_faces));
  EXPECT_TRUE(result.radiance == expected.radiance);
  EXPECT_EQ(result.grid.height, 72);
  EXPECT_THAT(result.format, HasSubstr("six files"));
  // Named by any other of them, or found by name.
  const auto other = folder_ / "sky_ny.exr";
  EXPECT_TRUE(project(other, settings_of(Layout::cube_faces)).radiance == expected.radiance);
  const Projection found = project(faces, settings_of(Layout::automatic));
  EXPECT_TRUE(found.radiance == expected.radiance);
  EXPECT_THAT(found.warnings, IsEmpty());
}

TEST_F(Layouts, ErrorsNameTheFileOfTheFace) {
  Picture strip = paint(scene(), Layout::cube_vertical_strip, 8);
  strip.at(0, 3 * 8 + 5, 2) = NAN;
  const auto faces = write_faces(strip, "bad");
  const auto refused = try_project(faces, settings_of(Layout::cube_faces));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, (folder_ / "bad_ny.exr").string() + ":5");
  EXPECT_THAT(refused.error().what, HasSubstr("row 5, column 2"));

  write(test::make_picture(9, 9, [](int, int, int) { return 1.0; }), "bad_pz");
  const auto uneven = try_project(faces, settings_of(Layout::cube_faces));
  ASSERT_FALSE(uneven);
  EXPECT_EQ(uneven.error().where, (folder_ / "bad_pz.exr").string());
  EXPECT_THAT(uneven.error().what, HasSubstr("9 x 9"));

  std::filesystem::remove(folder_ / "bad_nz.exr");
  const auto missing = try_project(faces, settings_of(Layout::cube_faces));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  EXPECT_THAT(missing.error().where, HasSubstr("bad_nz.exr"));
  const auto nameless = try_project(write(strip, "strip"), settings_of(Layout::cube_faces));
  ASSERT_FALSE(nameless);
  EXPECT_EQ(nameless.error().code, ErrorCode::usage);
}

// By the number of workers, the height of bands, and the target; in every sample type.
TEST_F(Layouts, AreTheSameBitsHoweverTheyAreComputed) {
  for (const Layout layout : {Layout::cube_horizontal_cross, Layout::angular, Layout::octahedral}) {
    const Picture picture = paint(scene(), layout, 24);
    for (const MapFormat format : {MapFormat::exr_half, MapFormat::exr_float, MapFormat::hdr}) {
      Picture safe = picture;
      for (auto& plane : safe.planes) {
        for (float& value : plane) value = std::isfinite(value) && value < 1e4F ? value : 9.0F;
      }
      const auto path = write(safe, "bits", format);
      for (const int degree : {2, 5}) {
        const Coefficients first = project(path, settings_of(layout, degree)).radiance;
        test::for_every_target([&] {
          for (const int rows : {1, 3, 17}) {
            ReadOptions options;
            options.rows_per_band = rows;
            EXPECT_TRUE(project(path, settings_of(layout, degree), options).radiance == first);
          }
        });
        ReadOptions options;
        options.rows_per_band = 1;
        ProjectionTables tables;
        auto shared = PanoramaProjection::open(path, options, settings_of(layout, degree), tables);
        ASSERT_TRUE(shared);
        const std::atomic<bool> stop{false};
        std::atomic<std::int64_t> pixels{0};
        {
          std::vector<std::jthread> workers;
          for (int i = 0; i < 3; ++i) {
            workers.emplace_back([&] { EXPECT_TRUE((*shared)->work(stop, pixels)); });
          }
        }
        const auto result = (*shared)->finish();
        ASSERT_TRUE(result);
        EXPECT_TRUE(result->radiance == first) << name_of(layout);
      }
    }
  }
}

// 1e-6 of the integral of |I Y_lm|, which sqrt((2l+1)/(4 pi)) times the flux bounds from above by a
// factor of a few; here against a flux with a sun of 1e5 in it.
TEST_F(Layouts, AreNearTheTwin) {
  for (const Layout layout : kOneFile) {
    const LayoutSize size = size_of(layout, 20);
    const auto path = write(test::make_noisy_picture(size.width, size.height, 5), "twin");
    const Projection fast = project(path, settings_of(layout, 6));
    const Projection twin = project(path, settings_of(layout, 6, Arithmetic::reference));
    for (int c = 0; c < kChannelCount; ++c) {
      const double flux = twin.radiance.channels[c][0] * std::sqrt(4.0 * kPi);
      for (int i = 0; i < coefficient_count(6); ++i) {
        EXPECT_NEAR(fast.radiance.channels[c][i], twin.radiance.channels[c][i], 5e-7 * flux);
      }
      EXPECT_NEAR(fast.pixels.mean[c], twin.pixels.mean[c], 1e-6 * twin.pixels.mean[c]);
    }
    EXPECT_EQ(fast.solid_angle, twin.solid_angle);
  }
}

// A grey picture, and one stored from right to left or by columns, are the same light.
TEST_F(Layouts, ReadEveryOrientationOfAFile) {
  const Picture picture = paint(scene(), Layout::cube_vertical_cross, 10);
  Picture safe = picture;
  for (auto& plane : safe.planes) {
    for (float& value : plane) value = std::isfinite(value) && value < 1e4F ? value : 9.0F;
  }
  const auto upright = write(safe, "upright", MapFormat::hdr);
  const Projection expected = project(upright, settings_of(Layout::cube_vertical_cross));
  const int w = safe.width, h = safe.height;
  const auto texel = [&](int row, int column) {
    return encode_rgbe(safe.at(0, row, column), safe.at(1, row, column), safe.at(2, row, column));
  };
  struct Orientation {
    std::string resolution;
    int lines, samples;
    std::function<std::pair<int, int>(int, int)> place;
  };
  const Orientation orientations[] = {{"-Y " + std::to_string(h) + " -X " + std::to_string(w), h, w,
                                       [&](int i, int j) { return std::pair(i, w - 1 - j); }},
                                      {"+X " + std::to_string(w) + " +Y " + std::to_string(h), w, h,
                                       [&](int i, int j) { return std::pair(h - 1 - j, i); }},
                                      {"+Y " + std::to_string(h) + " +X " + std::to_string(w), h, w,
                                       [&](int i, int j) { return std::pair(h - 1 - i, j); }}};
  for (const Orientation& orientation : orientations) {
    const auto path = folder_ / "turned.hdr";
    {
      std::ofstream file(path, std::ios::binary);
      file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" << orientation.resolution << "\n";
      for (int i = 0; i < orientation.lines; ++i) {
        for (int j = 0; j < orientation.samples; ++j) {
          const auto [row, column] = orientation.place(i, j);
          const auto bytes = texel(row, column);
          file.write(reinterpret_cast<const char*>(bytes.data()), 4);
        }
      }
    }
    const Projection turned = project(path, settings_of(Layout::cube_vertical_cross));
    EXPECT_LT(relative_error(turned.radiance, expected.radiance), 1e-6) << orientation.resolution;
    EXPECT_EQ(turned.pixels.pixel_count, 600);
  }
}

// The policy sees the texels of the sphere and no others.
TEST_F(Layouts, ApplyThePixelPolicy) {
  Picture picture = paint(scene(), Layout::angular, 32);
  picture.at(0, 16, 16) = -1.0F;
  picture.at(1, 10, 12) = NAN;
  picture.at(2, 20, 18) = 500.0F;
  const auto path = write(picture, "policy");
  ProjectionSettings settings = settings_of(Layout::angular);
  const auto refused = try_project(path, settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("1 pixel is not finite"));
  EXPECT_THAT(refused.error().what, HasSubstr("row 10, column 12"));
  settings.pixels.nonfinite = PixelPolicy::NonFinite::zero;
  const Projection before = project(path, settings);
  EXPECT_EQ(before.pixels.nonfinite_count, 1);
  EXPECT_EQ(before.pixels.negative_count, 1);
  EXPECT_EQ(before.pixels.minimum[0], -1.0);
  EXPECT_EQ(before.pixels.maximum[2], 500.0);
  settings.pixels.clamp = 10.0;
  const Projection after = project(path, settings);
  EXPECT_EQ(after.pixels.clamped_count, 1);
  auto geometry = TexelGeometry::create(Layout::angular, 32, 32);
  EXPECT_NEAR(after.pixels.clamped_flux[2], 490.0 * geometry->texel(20, 18).solid_angle, 1e-5);
  EXPECT_NEAR(
      std::sqrt(4.0 * kPi) * (before.radiance.channels[2][0] - after.radiance.channels[2][0]),
      after.pixels.clamped_flux[2], 1e-5);
  settings.arithmetic = Arithmetic::reference;
  EXPECT_EQ(project(path, settings).pixels.clamped_flux, after.pixels.clamped_flux);
}

TEST_F(Layouts, TakeTheLargestFloats) {
  const auto path = write(test::make_picture(16, 16, [](int, int, int) { return 3e38; }), "huge");
  const Projection result = project(path, settings_of(Layout::octahedral, 0));
  EXPECT_NEAR(result.radiance.channels[0][0] / (std::sqrt(4.0 * kPi) * 3e38), 1.0, 1e-6);
}

TEST_F(Layouts, AutoSaysWhatItTook) {
  const auto notes = [&](int width, int height) {
    const auto path =
        write(test::make_picture(width, height, [](int, int, int) { return 1.0; }), "auto");
    const Projection result = project(path, settings_of(Layout::automatic));
    EXPECT_NEAR(result.radiance.channels[0][0] / std::sqrt(4.0 * kPi), 1.0, 0.02);
    return result.warnings;
  };
  EXPECT_THAT(notes(64, 32), IsEmpty());
  EXPECT_THAT(notes(30, 40),
              ElementsAre(HasSubstr("cube-vertical-cross, because its aspect is 3:4")));
  EXPECT_THAT(notes(40, 30), ElementsAre(HasSubstr("cube-horizontal-cross")));
  EXPECT_THAT(notes(10, 60), ElementsAre(HasSubstr("cube-vertical-strip")));
  EXPECT_THAT(notes(60, 10), ElementsAre(HasSubstr("cube-horizontal-strip")));
  EXPECT_THAT(notes(32, 32), ElementsAre(HasSubstr("angular map, because it is square")));
  EXPECT_THAT(notes(65, 32), ElementsAre(HasSubstr("aspect of no layout")));
}

TEST_F(Layouts, RefuseAnAspectThatIsNotTheirs) {
  const auto path = write(test::make_picture(64, 32, [](int, int, int) { return 1.0; }), "plain");
  const auto refused = try_project(path, settings_of(Layout::mirror_ball));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().where, path.string());
}

}  // namespace
}  // namespace shoal
