// The scenes that show pixels beside coefficients: sphere, lit, compare, contact.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "scenes/equirect.h"
#include "scenes/scene.h"
#include "sphere/rotation.h"
#include "sphere/turns.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "viz/scenes/made_library.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

constexpr SceneKind kHere[] = {SceneKind::sphere, SceneKind::lit, SceneKind::compare,
                               SceneKind::contact};

class PixelScenes : public testing::Test {
 protected:
  void SetUp() override {
    const std::string place = std::filesystem::path(SHOAL_PROGRAM).parent_path().string();
    ::setenv("PATH", (place + ":/usr/bin:/bin").c_str(), 1);
    auto window = make_offscreen_window({640, 360});
    if (!window) GTEST_SKIP() << window.error().text();
    window_ = *window;
    for (Panorama& panorama : library_.panoramas) {
      panorama.file = folder_ / (panorama.name + ".exr");
      write(synthesise(panorama.coefficients, 128, 64), panorama.file);
    }
  }

  static void write(const Pixels& pixels, const std::filesystem::path& path) {
    const auto picture = shoal::test::make_picture(
        pixels.width, pixels.height, [&](int c, int i, int j) { return pixels.at(i, j)[c]; });
    shoal::test::write_picture(picture, MapFormat::exr_float, path);
  }

  Status show(SceneKind kind) {
    return show_scene(kind, {&library_, current_, other_, settings_, &pixels_}, *window_);
  }

  Picture picture_of(SceneKind kind) {
    const Status status = show(kind);
    EXPECT_TRUE(status) << name_of(kind) << ": " << status.error().text();
    return take_picture(*window_);
  }

  shoal::test::TemporaryFolder folder_;
  Library library_ = test::made_library();
  std::size_t current_ = 0;
  std::optional<std::size_t> other_;
  SceneSettings settings_;
  PixelCache pixels_{library_};
  vtkSmartPointer<vtkRenderWindow> window_;
};

TEST_F(PixelScenes, AreTheSameTwiceAndAfterAnother) {
  for (const SceneKind kind : kHere) {
    const Picture first = picture_of(kind);
    picture_of(SceneKind::lobes);
    EXPECT_EQ(picture_of(kind), first) << name_of(kind);
  }
}

// Nothing is cut off: a frame two pixels wide stays background.
TEST_F(PixelScenes, KeepAwayFromTheBorder) {
  for (const PictureSize size : {PictureSize{640, 360}, {500, 500}, {400, 800}, {960, 200}}) {
    window_->SetSize(size.width, size.height);
    for (const SceneKind kind : kHere) {
      const Picture picture = picture_of(kind);
      const auto pixel = [&](int row, int column) {
        const unsigned char* p = picture.rgb.data() + 3 * (row * size.width + column);
        return std::array<int, 3>{p[0], p[1], p[2]};
      };
      for (int row = 0; row < size.height; ++row) {
        for (int column = 0; column < size.width; ++column) {
          const bool border =
              row < 2 || column < 2 || row >= size.height - 2 || column >= size.width - 2;
          if (border) {
            ASSERT_EQ(pixel(row, column), pixel(0, 0))
                << name_of(kind) << ' ' << column << ' ' << row << " of " << size.width;
          }
        }
      }
    }
  }
}

TEST_F(PixelScenes, ShowWhatTheSettingsSay) {
  for (const SceneKind kind : kHere) {
    const Picture plain = picture_of(kind);
    const auto changes = [&](auto change) {
      const SceneSettings settings = settings_;
      change(settings_);
      const bool differs = picture_of(kind) != plain;
      settings_ = settings;
      return differs;
    };
    EXPECT_TRUE(changes([](SceneSettings& s) { s.exposure_stops = -2.0; })) << name_of(kind);
    // The nine coefficients of lit are those of degree 2, whatever is shown elsewhere.
    EXPECT_EQ(changes([](SceneSettings& s) { s.degree = 1; }), kind != SceneKind::lit)
        << name_of(kind);
    // The equirect plane is the same in every frame.
    EXPECT_EQ(changes([](SceneSettings& s) { s.frame = *parse_frame("openexr"); }),
              kind != SceneKind::compare)
        << name_of(kind);
    EXPECT_EQ(changes([](SceneSettings& s) { s.channel = Channel::blue; }),
              kind == SceneKind::compare || kind == SceneKind::contact)
        << name_of(kind);
  }
}

TEST_F(PixelScenes, CompareTwoPanoramas) {
  const Picture alone = picture_of(SceneKind::compare);
  other_ = 1;
  EXPECT_NE(picture_of(SceneKind::compare), alone);
}

// The brighter one decides: at the exposure of the other, sixteen times the light would be white
// all over, whichever side it is on.
TEST_F(PixelScenes, CompareAtTheExposureOfTheBrighterOne) {
  Coefficients constant(0);
  for (auto& channel : constant.channels) channel[0] = 1.0;
  library_.panoramas[0] = test::panorama_of("dim", constant);
  for (auto& channel : constant.channels) channel[0] = 16.0;
  library_.panoramas[1] = test::panorama_of("bright", constant);
  for (const std::size_t first : {0, 1}) {
    current_ = first;
    other_ = 1 - first;
    const Picture picture = picture_of(SceneKind::compare);
    for (const int column : {picture.size.width / 4, picture.size.width * 3 / 4}) {
      const unsigned char* p =
          picture.rgb.data() + 3 * (picture.size.height * 3 / 10 * picture.size.width + column);
      EXPECT_LT(p[0], 200) << first << ' ' << column;
    }
  }
}

// Compared as the file lies, a light that was turned and one that was not are the same two pictures
// with the same figures: below the titles of the upper two, which say that it was changed, and
// above the caption no more than roundings differ.
TEST_F(PixelScenes, CompareATurnedLightByItsOwnTexels) {
  window_->SetSize(900, 360);  // the caption is a line of both
  Panorama& panorama = library_.panoramas[0];
  const glm::dmat3 turn = *turn_matrix({37.0, 20.0, 0.0});
  const Picture plain = picture_of(SceneKind::compare);
  panorama.coefficients = rotate(panorama.coefficients, turn);
  panorama.change = LightChange{glm::dmat3(1.0), turn};
  const Picture turned = picture_of(SceneKind::compare);
  EXPECT_NE(turned, plain);
  const int row_bytes = 3 * plain.size.width;
  int differing = 0;
  for (int i = plain.size.height / 5 * row_bytes; i < plain.size.height * 9 / 10 * row_bytes; ++i) {
    differing += plain.rgb[i] != turned.rgb[i] ? 1 : 0;
  }
  EXPECT_LT(differing, 50);
}

// Without files there is still something to see, and to compare with no more than itself.
TEST_F(PixelScenes, ManageWithoutPixels) {
  for (Panorama& panorama : library_.panoramas) panorama.file.clear();
  for (const SceneKind kind : {SceneKind::sphere, SceneKind::lit, SceneKind::contact}) {
    picture_of(kind);
  }
  const Status status = show(SceneKind::compare);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::usage);
  EXPECT_NE(status.error().text().find("--with"), std::string::npos);
  settings_.degree = 2;
  picture_of(SceneKind::compare);
  other_ = 1;
  picture_of(SceneKind::compare);
}

TEST_F(PixelScenes, ManageTheDarkAndOneCoefficient) {
  library_.panoramas[0] = test::panorama_of("dark", Coefficients(0));
  library_.panoramas[0].file = folder_ / "dark.exr";
  write({4, 2, std::vector<float>(24, 0.0f)}, library_.panoramas[0].file);
  for (const SceneKind kind : kHere) picture_of(kind);
}

}  // namespace
}  // namespace shoal::viz
