// Every built-in profile against what its consumer does with the numbers.
//
// The evaluators are profile_evaluators.h's. Each is fed the file as text, and must give the
// irradiance of the same light in the consumer's frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "profile_evaluators.h"

namespace shoal {
namespace {

using namespace test;

// Panorama centre, right and up in the consumers' axes.
const Vec kX(1, 0, 0), kYAxis(0, 1, 0), kZ(0, 0, 1);
const Axes kNative{-kX, -kYAxis, kZ};
const Axes kMirrored{kZ, kX, kYAxis};     // cmft, Babylon, cmgen --no-mirror
const Axes kUnmirrored{kZ, -kX, kYAxis};  // cmgen, OpenEXR
const Axes kThree{kX, kZ, kYAxis};        // three.js, glTF's draft
const Axes kLooksBack{-kZ, kX, kYAxis};   // right-handed, cameras look along -z: a stated default
const Axes kUnreal{kX, kYAxis, kZ};       // a stated default

struct Consumer {
  std::string name;
  test::Options options;
  Axes axes;
  int degree;
  double tolerance;  // of the sum of all |E_lm|
  Evaluator (*read)(const std::string& text);
};

// Numbers are rounded to float32 once, 6e-8 of each, and constants have nine digits: 1e-6 leaves a
// factor of ten. Consumers whose own constants have six digits get what these are off by.
constexpr double kFloat = 1e-6;
constexpr double kSixDigits = 4e-6;
constexpr double kDouble = 1e-13;

const std::vector<Consumer>& consumers() {
  static const std::vector<Consumer> kConsumers = {
      {"plain-radiance", {}, kNative, 6, kDouble, plain_radiance},
      {"plain-irradiance", {}, kNative, 6, kDouble, plain_irradiance},
      {"plain-irradiance", {{"over_pi", "yes"}}, kNative, 6, kDouble, plain_irradiance_over_pi},
      {"numpy", {}, kNative, 6, kFloat, numpy},
      {"ramamoorthi", {}, kNative, 2, kFloat, ramamoorthi},
      {"glsl", {}, kUnmirrored, 2, kFloat, glsl},
      {"hlsl", {}, kMirrored, 2, kFloat, hlsl},
      {"three", {}, kThree, 2, kFloat, three},
      {"webxr", {}, kLooksBack, 2, kFloat, webxr},
      {"babylon", {}, kMirrored, 2, kFloat, babylon_lambertian},
      {"babylon", {{"stage", "radiance"}}, kMirrored, 2, kFloat, babylon_radiance},
      {"babylon", {{"stage", "irradiance"}}, kMirrored, 2, kFloat, babylon_irradiance},
      {"babylon", {{"stage", "prescaled"}}, kMirrored, 2, kFloat, bare_coefficients},
      {"filament", {}, kUnmirrored, 2, kFloat, filament},
      {"filament-cmgen", {}, kUnmirrored, 2, kFloat, cmgen},
      {"filament-cmgen", {{"scale", "before"}}, kUnmirrored, 2, kFloat, cmgen_before},
      {"unity", {}, kMirrored, 2, kFloat, unity},
      {"unity-shader", {}, kMirrored, 2, kFloat, unity_shader},
      {"unreal", {}, kUnreal, 2, kFloat, unreal},
      {"unreal-float4", {}, kUnreal, 2, kFloat, unreal_float4},
      {"godot", {}, kLooksBack, 2, kFloat, godot},
      {"playcanvas", {}, kLooksBack, 2, kFloat, playcanvas},
      {"playcanvas", {{"scale", "shFromCubemap"}}, kLooksBack, 2, kFloat, playcanvas_from_cubemap},
      {"cesium", {}, kMirrored, 2, kFloat, bare_coefficients},
      {"cesium", {{"shader", "before"}}, kMirrored, 2, kSixDigits, cesium_before},
      {"gltf", {}, kThree, 2, kFloat, gltf},
      {"gltf",
       {{"convolved", "no"}, {"sign", "condon-shortley"}},
       kThree,
       2,
       kFloat,
       gltf_unconvolved},
      {"gltf", {{"convolved", "no"}, {"sign", "plain"}}, kThree, 2, kFloat, gltf_unconvolved_plain},
      {"directxmath", {}, kMirrored, 2, kFloat, directxmath},
      {"arcore", {}, kLooksBack, 2, kSixDigits, arcore},
      {"google-sh", {}, kNative, 2, kSixDigits, google_sh},
      {"cmft", {}, kMirrored, 4, kDouble, cmft},
  };
  return kConsumers;
}

class ProfileConsumers : public testing::TestWithParam<Consumer> {};

TEST_P(ProfileConsumers, GetOurIrradianceInTheirFrame) {
  const Consumer& consumer = GetParam();
  const Coefficients light = test::random_light(6);
  const std::string text = test::export_text(consumer.name, consumer.options, light);
  const Evaluator evaluator = consumer.read(text);
  const double size = test::irradiance_size(light);
  for (const Vec& d : test::hundred_directions()) {
    const Vec expected = test::irradiance_at(light, consumer.degree, consumer.axes, d);
    const Vec got = evaluator(d);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(got[c], expected[c], consumer.tolerance * size)
          << consumer.name << " channel " << c << "\n"
          << text;
    }
  }
}

std::string name_of_case(const testing::TestParamInfo<Consumer>& info) {
  std::string name = info.param.name;
  for (const auto& [option, word] : info.param.options) name += "_" + option + "_" + word;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ProfileConsumers, testing::ValuesIn(consumers()), name_of_case);

TEST(ProfileConsumersTable, HasEveryBuiltInProfile) {
  std::set<std::string> tested = {"zh3", "l1-nonlinear"};  // profile_models_test.cpp
  for (const Consumer& consumer : consumers()) tested.insert(consumer.name);
  std::set<std::string> names(builtin_profile_names().begin(), builtin_profile_names().end());
  EXPECT_EQ(tested, names);
}

// A frame of the user's takes the place of the profile's, and of an option's.
TEST(ProfileConsumersTable, AFrameOfTheUsersWins) {
  const Coefficients light = test::random_light(2);
  auto profile = find_profile("unity");
  ASSERT_TRUE(profile);
  profile->frame = *parse_frame("-y,+z,+x");
  const auto text = write_profile_text(*profile, light, {"hall", ""});
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("frame -y,+z,+x"), text->npos);
  const Evaluator evaluator = unity(*text);
  for (const Vec& d : test::hundred_directions()) {
    const Vec expected = test::irradiance_at(light, 2, {-kYAxis, kZ, kX}, d);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(evaluator(d)[c], expected[c], kFloat * test::irradiance_size(light));
    }
  }
}

}  // namespace
}  // namespace shoal
