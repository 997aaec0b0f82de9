#include <gtest/gtest.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "scenes/colours.h"
#include "scenes/scene.h"
#include "viz/scenes/made_library.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

class Scenes : public testing::Test {
 protected:
  void SetUp() override {
    auto window = make_offscreen_window({640, 360});
    if (!window) GTEST_SKIP() << window.error().text();
    window_ = *window;
  }

  Picture picture_of(SceneKind kind) {
    const Status status =
        show_scene(kind, {&library_, current_, std::nullopt, settings_, &pixels_}, *window_);
    EXPECT_TRUE(status) << status.error().text();
    return take_picture(*window_);
  }

  Library library_ = test::made_library();
  std::size_t current_ = 0;
  SceneSettings settings_;
  PixelCache pixels_{library_};
  vtkSmartPointer<vtkRenderWindow> window_;
};

std::array<int, 3> pixel(const Picture& picture, int column, int row) {
  const unsigned char* p = picture.rgb.data() + 3 * (row * picture.size.width + column);
  return {p[0], p[1], p[2]};
}

constexpr SceneKind kHere[] = {SceneKind::basis, SceneKind::lobes, SceneKind::degrees};

TEST(SceneNames, ComeBack) {
  for (const SceneKind kind : kAllScenes) {
    const auto back = parse_scene(name_of(kind));
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, kind);
  }
  EXPECT_EQ(parse_scene("lobe").error().text(),
            "there is no scene \"lobe\" (did you mean \"lobes\"?)");
}

TEST_F(Scenes, AreTheSameTwiceAndAfterAnother) {
  for (const SceneKind kind : kHere) {
    const Picture first = picture_of(kind);
    picture_of(SceneKind::lobes);
    EXPECT_EQ(picture_of(kind), first) << name_of(kind);
  }
}

// Nothing is cut off: a frame two pixels wide stays background.
TEST_F(Scenes, KeepAwayFromTheBorder) {
  for (const PictureSize size : {PictureSize{640, 360}, {1280, 720}, {600, 600}, {300, 500}}) {
    window_->SetSize(size.width, size.height);
    for (const SceneKind kind : kHere) {
      const Picture picture = picture_of(kind);
      const std::array<int, 3> background = pixel(picture, 0, 0);
      for (int row = 0; row < size.height; ++row) {
        for (int column = 0; column < size.width; ++column) {
          const bool border =
              row < 2 || column < 2 || row >= size.height - 2 || column >= size.width - 2;
          if (border) {
            ASSERT_EQ(pixel(picture, column, row), background)
                << name_of(kind) << ' ' << column << ' ' << row << " of " << size.width;
          }
        }
      }
    }
  }
}

// A light at the frame's +z, drawn: the middle of the lobe's orange pixels lies from the drawn
// origin towards the drawn +z.
TEST_F(Scenes, ALightAtPlusZPointsAlongTheDrawnPlusZInEveryFrame) {
  for (const FrameAlias& alias : frame_aliases()) {
    settings_.frame = alias.frame;
    const glm::dvec3 native =
        glm::transpose(native_to_frame(alias.frame)) * glm::dvec3(0.0, 0.0, 1.0);
    library_.panoramas[0] =
        test::panorama_of("light", test::light_from(native, {1.0, 1.0, 1.0}, 6));
    const Picture picture = picture_of(SceneKind::lobes);

    glm::dvec2 sum(0.0);
    double count = 0.0;
    for (int row = 0; row < picture.size.height; ++row) {
      for (int column = 0; column < picture.size.width * 7 / 10; ++column) {
        const auto [r, g, b] = pixel(picture, column, row);
        if (r < b + 60 || r < g + 20) continue;
        sum += glm::dvec2(column, picture.size.height - 1 - row);
        ++count;
      }
    }
    ASSERT_GT(count, 100.0) << alias.name;
    vtkRenderer* view = nullptr;
    vtkCollectionSimpleIterator cookie;
    vtkRendererCollection* all = window_->GetRenderers();
    all->InitTraversal(cookie);
    while (vtkRenderer* renderer = all->GetNextRenderer(cookie)) {
      if (renderer->GetInteractive()) view = renderer;
    }
    ASSERT_NE(view, nullptr);
    const auto drawn = [&](double z) {
      view->SetWorldPoint(0.0, 0.0, z, 1.0);
      view->WorldToDisplay();
      return glm::dvec2(view->GetDisplayPoint()[0], view->GetDisplayPoint()[1]);
    };
    const glm::dvec2 axis = glm::normalize(drawn(1.0) - drawn(0.0));
    const glm::dvec2 lobe = sum / count - drawn(0.0);
    EXPECT_GT(glm::dot(axis, glm::normalize(lobe)), 0.98) << alias.name;
    EXPECT_GT(glm::length(lobe), 5.0) << alias.name;
  }
}

// Where a renderer of the window shows a point.
glm::dvec2 shown_at(vtkRenderer& renderer, const glm::dvec3& point) {
  renderer.SetWorldPoint(point.x, point.y, point.z, 1.0);
  renderer.WorldToDisplay();
  return {renderer.GetDisplayPoint()[0], renderer.GetDisplayPoint()[1]};
}

struct DrawnName {
  std::string text;  // "+x", a minus as long as a plus otherwise
  glm::dvec3 point;
  vtkRenderer* renderer;
};

std::vector<DrawnName> drawn_names(vtkRenderWindow& window) {
  std::vector<DrawnName> names;
  vtkCollectionSimpleIterator cookie;
  window.GetRenderers()->InitTraversal(cookie);
  while (vtkRenderer* renderer = window.GetRenderers()->GetNextRenderer(cookie)) {
    vtkCollectionSimpleIterator props;
    renderer->GetViewProps()->InitTraversal(props);
    while (vtkProp* prop = renderer->GetViewProps()->GetNextProp(props)) {
      auto* name = vtkBillboardTextActor3D::SafeDownCast(prop);
      if (name == nullptr) continue;
      const double* at = name->GetPosition();
      names.push_back({name->GetInput(), {at[0], at[1], at[2]}, renderer});
    }
  }
  return names;
}

// The name "+x" stands on the positive x axis as it is drawn, "-x" on the other half, and so on:
// all six, in every scene and frame that names axes. Lobes are drawn along those axes by the test
// above.
TEST_F(Scenes, NameTheHalfAxesThatTheyStandAt) {
  for (const FrameAlias& alias : frame_aliases()) {
    settings_.frame = alias.frame;
    for (const SceneKind kind : {SceneKind::basis, SceneKind::lobes, SceneKind::sphere}) {
      picture_of(kind);
      const std::vector<DrawnName> names = drawn_names(*window_);
      std::set<std::string> met;
      for (const DrawnName& name : names) {
        const std::size_t axis = std::string("xyz").find(name.text.back());
        ASSERT_NE(axis, std::string::npos) << name.text;
        glm::dvec3 expected(0.0);
        expected[static_cast<int>(axis)] = name.text.front() == '+' ? 1.0 : -1.0;
        EXPECT_GT(glm::dot(expected, glm::normalize(name.point)), 0.9999) << name.text;
        const glm::dvec2 middle = shown_at(*name.renderer, glm::dvec3(0.0));
        const glm::dvec2 there = shown_at(*name.renderer, name.point) - middle;
        const glm::dvec2 axis_end = shown_at(*name.renderer, expected) - middle;
        EXPECT_GT(glm::dot(glm::normalize(there), glm::normalize(axis_end)), 0.9999) << name.text;
        met.insert(name.text);
      }
      EXPECT_EQ(met.size(), 6u) << name_of(kind) << ' ' << alias.name;
    }
  }
}

TEST_F(Scenes, ShowWhatTheSettingsSay) {
  const Picture plain = picture_of(SceneKind::lobes);
  const auto changed = [&](auto change) {
    const SceneSettings before = settings_;
    change(settings_);
    const bool differs = picture_of(SceneKind::lobes) != plain;
    settings_ = before;
    return differs;
  };
  EXPECT_TRUE(changed([](SceneSettings& s) { s.degree = 2; }));
  EXPECT_TRUE(changed([](SceneSettings& s) { s.quantity = Quantity::irradiance; }));
  EXPECT_TRUE(changed([](SceneSettings& s) { s.channel = Channel::blue; }));
  EXPECT_TRUE(changed([](SceneSettings& s) { s.colour = LobeColour::light; }));
  EXPECT_TRUE(changed([](SceneSettings& s) { s.frame = *parse_frame("openexr"); }));
  EXPECT_FALSE(changed([](SceneSettings& s) { s.grid = Grid{3, 3}; }));
}

TEST_F(Scenes, ManageDegreesFromNothingToMany) {
  library_.panoramas[0] =
      test::panorama_of("many", test::light_from({1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, 20));
  for (const int degree : {0, 1, 20}) {
    settings_.degree = degree;
    picture_of(SceneKind::degrees);
    picture_of(SceneKind::lobes);
  }
  for (const int degree : {0, 9, 14}) {  // labels below the lobes, and along the edges
    settings_.degree = degree;
    picture_of(SceneKind::basis);
  }
  settings_.degree = 0;
  library_.panoramas[0] = test::panorama_of("dark", Coefficients(0));
  picture_of(SceneKind::degrees);
  picture_of(SceneKind::lobes);
}

TEST_F(Scenes, NeedAPanorama) {
  library_.panoramas.clear();
  const SceneInput input{&library_, 0, std::nullopt, settings_, &pixels_};
  EXPECT_EQ(show_scene(SceneKind::lobes, input, *window_).error().code, ErrorCode::usage);
  EXPECT_TRUE(show_scene(SceneKind::basis, input, *window_));
}

}  // namespace
}  // namespace shoal::viz
