#include "sphere/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "sphere/basis.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// Direction of a pixel by the tool's own formula, s = sin(theta).
using PixelDirection = std::function<glm::dvec3(double theta, double phi)>;

glm::dvec3 native(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

glm::dvec3 as_cmft(double theta, double phi) {
  return {-std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

glm::dvec3 as_vtk(double theta, double phi) {
  return {-std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)};
}

glm::dvec3 as_materialx(double theta, double phi) {
  return {-std::sin(theta) * std::sin(phi), -std::cos(theta), std::sin(theta) * std::cos(phi)};
}

glm::dvec3 as_cmgen(double theta, double phi) { return as_cmft(theta, phi) * glm::dvec3(-1, 1, 1); }

const std::pair<std::string_view, PixelDirection> kFormulas[] = {{"native", native},
                                                                 {"google-sh", native},
                                                                 {"libsharp", native},
                                                                 {"cmft", as_cmft},
                                                                 {"cmgen-no-mirror", as_cmft},
                                                                 {"babylon", as_cmft},
                                                                 {"cmgen", as_cmgen},
                                                                 {"vtk", as_vtk},
                                                                 {"three", as_vtk},
                                                                 {"materialx", as_materialx}};

TEST(Frame, AliasesFollowTheirToolsFormulas) {
  for (const auto& [name, direction] : kFormulas) {
    const auto frame = parse_frame(name);
    ASSERT_TRUE(frame.ok()) << name;
    const glm::dmat3 matrix = native_to_frame(*frame);
    for (double theta : {0.0, 0.4, 1.5, 2.9}) {
      for (double phi : {0.1, 1.3, 3.0, 5.5}) {
        const glm::dvec3 difference = matrix * native(theta, phi) - direction(theta, phi);
        EXPECT_LT(glm::length(difference), 1e-15) << name;
      }
    }
  }
}

// Those established by where centre (phi = pi), right (3 pi/2) and up lie.
TEST(Frame, AliasesFollowTheTableOfPanoramaFrames) {
  const std::pair<std::string_view, std::string_view> rows[] = {
      {"google-sh", "-x,-y,+z"}, {"cmgen-no-mirror", "+z,+x,+y"},
      {"cmgen", "+z,-x,+y"},     {"openexr", "+z,-x,+y"},
      {"usd", "+z,-x,+y"},       {"mitsuba", "+z,-x,+y"},
      {"oiio", "+z,-x,+y"},      {"gltf", "+x,+z,+y"}};
  for (const auto& [name, axes] : rows) EXPECT_EQ(text_of(*parse_frame(name)), axes) << name;
}

TEST(Frame, HalfAxesAreUnitVectors) {
  EXPECT_EQ(direction_of({0, 1}), glm::dvec3(1, 0, 0));
  EXPECT_EQ(direction_of({1, -1}), glm::dvec3(0, -1, 0));
  EXPECT_EQ(direction_of({2, 1}), glm::dvec3(0, 0, 1));
  for (const FrameAlias& alias : frame_aliases()) {
    const auto& [center, right, up] = alias.frame;
    const glm::dmat3 axes(direction_of(center), direction_of(right), direction_of(up));
    EXPECT_EQ(glm::transpose(axes) * axes, glm::dmat3(1.0)) << alias.name;
  }
}

// The tools' formulas put the picture's three points where the frame says.
TEST(Frame, CentreRightAndUpAreWhereTheFrameSays) {
  for (const FrameAlias& alias : frame_aliases()) {
    const glm::dmat3 matrix = native_to_frame(alias.frame);
    const auto expect_at = [&](const SignedAxis& axis, const glm::dvec3& native_direction) {
      EXPECT_LT(glm::distance(matrix * native_direction, direction_of(axis)), 1e-15) << alias.name;
    };
    expect_at(alias.frame.center, native(kPi / 2, kPi));
    expect_at(alias.frame.right, native(kPi / 2, 1.5 * kPi));
    expect_at(alias.frame.up, native(0.0, 0.0));
  }
}

// Seen from inside a right-handed frame, right is forward x up; the picture is mirrored where its
// own right is the other way: so for google/spherical-harmonics and cmgen --no-mirror, not for the
// others.
TEST(Frame, MirrorsTellsHowThePictureIsSeenFromInside) {
  for (const FrameAlias& alias : frame_aliases()) {
    const glm::dmat3 matrix = native_to_frame(alias.frame);
    const glm::dvec3 center = matrix * glm::dvec3(-1, 0, 0);
    const glm::dvec3 right = matrix * glm::dvec3(0, -1, 0);
    const glm::dvec3 up = matrix * glm::dvec3(0, 0, 1);
    EXPECT_EQ(glm::dot(glm::cross(center, up), right) > 0, mirrors(alias.frame)) << alias.name;
  }
  EXPECT_FALSE(mirrors(*parse_frame("native")));
  EXPECT_FALSE(mirrors(*parse_frame("cmgen-no-mirror")));
  EXPECT_TRUE(mirrors(*parse_frame("cmgen")));
  EXPECT_TRUE(mirrors(*parse_frame("openexr")));
  EXPECT_TRUE(mirrors(*parse_frame("three")));
}

TEST(Frame, CoefficientsFollowTheLight) {
  const Coefficients light = test::random_coefficients(6);
  for (const FrameAlias& alias : frame_aliases()) {
    const Coefficients moved = to_frame(light, alias.frame);
    for (const glm::dvec3& d : test::random_directions(10)) {
      const glm::dvec3 expected = evaluate(light, d);
      const glm::dvec3 found = evaluate(moved, native_to_frame(alias.frame) * d);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-13) << alias.name;
    }
  }
}

TEST(Frame, NativeLeavesTheBits) {
  const Coefficients light = test::random_coefficients(9);
  EXPECT_EQ(to_frame(light, Frame{}), light);
  EXPECT_EQ(native_to_frame(Frame{}), glm::dmat3(1.0));
  EXPECT_EQ(*parse_frame("native"), Frame{});
}

TEST(Frame, All48SignedPermutationsReadBackAndHalfOfThemMirror) {
  const std::string_view axes[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  std::set<std::string> texts;
  int mirrored = 0;
  for (auto center : axes) {
    for (auto right : axes) {
      for (auto up : axes) {
        const auto frame = parse_frame(center, right, up);
        const bool distinct = center[1] != right[1] && right[1] != up[1] && up[1] != center[1];
        ASSERT_EQ(frame.ok(), distinct);
        if (!distinct) continue;
        texts.insert(text_of(*frame));
        EXPECT_EQ(*parse_frame(text_of(*frame)), *frame);
        mirrored += mirrors(*frame);
      }
    }
  }
  EXPECT_EQ(texts.size(), 48u);
  EXPECT_EQ(mirrored, 24);
}

TEST(Frame, ReadsWhatPeopleWrite) {
  const Frame openexr = *parse_frame("openexr");
  for (std::string_view text : {"+z,-x,+y", " +Z , -X, +Y ", "z,-x,y", "OpenEXR"}) {
    const auto frame = parse_frame(text);
    ASSERT_TRUE(frame.ok()) << text;
    EXPECT_EQ(*frame, openexr) << text;
  }
  EXPECT_EQ(*parse_frame("+z", "-x", "y"), openexr);
}

TEST(Frame, ErrorsSayWhatToDo) {
  const auto error_of = [](std::string_view text) { return parse_frame(text).error(); };
  EXPECT_EQ(error_of("opnexr").what, "unknown frame \"opnexr\"");
  EXPECT_EQ(error_of("opnexr").hint, "did you mean \"openexr\"?");
  EXPECT_EQ(error_of("+z,-w,+y").what, "\"-w\" is not a signed axis");
  EXPECT_EQ(error_of("+z,-x").what, "a frame has three axes, \"+z,-x\" has 2");
  EXPECT_EQ(error_of("+z,-x,+x").what, "the frame +z,-x,+x uses an axis twice");
  for (std::string_view text : {"", ",,", "+z,-x,+y,+x", "zz,x,y", "+,-x,+y", "a,b,c"}) {
    ASSERT_FALSE(parse_frame(text).ok()) << text;
    EXPECT_EQ(error_of(text).code, ErrorCode::usage);
    EXPECT_FALSE(error_of(text).hint.empty());
  }
}

}  // namespace
}  // namespace shoal
