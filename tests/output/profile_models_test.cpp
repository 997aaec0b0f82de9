// Profiles that hold less than all coefficients to degree 2: their evaluators, from the papers,
// against the forms of sphere/zh3.h, and the GLSL that they write run on the same directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compute_shader.h"
#include "profile_support.h"
#include "sphere/zh3.h"

namespace shoal {
namespace {

using Vec = glm::dvec3;

// The frame of both profiles: the centre at +z, its right at -x, up at +y.
const test::Axes kAxes{{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}};

// Numbers are float32 and so is the shader: twenty operations, as in profile_shaders_test.cpp.
constexpr double kFloat = 1e-6;
constexpr double kShader = 4e-6;

Vec irradiance_of(const Coefficients& radiance, const Vec& native) {
  return evaluate(apply_quantity(radiance, Quantity::irradiance), native);
}

// What the written numbers say of a direction: linear and zonal part (Roughton et al. 2024).
Vec zh3_of(const std::string& text, const Vec& n) {
  const auto linear = test::numbers_in(text, "vec4[3](", ");\n  const");
  const auto zonal = test::numbers_in(text, "shoal_zonal = vec3(", ")");
  std::vector<double> l;  // without the 4 of "vec4("
  for (std::size_t i = 0; i < linear.size(); ++i) {
    if (i % 5 != 0) l.push_back(linear[i]);
  }
  if (l.size() < 12 || zonal.size() != 3) return Vec(NAN);
  const auto part = [&](int c) { return Vec(l[4 * c], l[4 * c + 1], l[4 * c + 2]); };
  const Vec axis = glm::normalize(0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2));
  const double z = glm::dot(axis, n);
  Vec sum(0.0);
  for (int c = 0; c < 3; ++c) {
    sum[c] = glm::dot(part(c), n) + l[4 * c + 3] + zonal[c] * (3 * z * z - 1);
  }
  return sum;
}

void expect_equal(const Vec& got, const Vec& expected, double tolerance, const std::string& what) {
  for (int c = 0; c < 3; ++c) ASSERT_NEAR(got[c], expected[c], tolerance) << what;
}

// Light about one axis: q of each channel is its degree 2, so nothing is lost.
TEST(ProfileModels, Zh3HoldsLightAboutOneAxis) {
  const Vec axis = glm::normalize(Vec(0.3, -0.5, 0.8));
  Coefficients light(2);
  std::vector<double> y(coefficient_count(2));
  Basis<double>(2).evaluate(axis, y);
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = 0; i < coefficient_count(2); ++i) {
      light.channels[c][i] = y[i] * (i == 0 ? 9.0 : i < 4 ? 4.0 + c : 1.0 - 0.5 * c);
    }
  }
  const std::string text = test::export_text("zh3", {}, light);
  for (const Vec& d : test::hundred_directions()) {
    expect_equal(zh3_of(text, d), irradiance_of(light, kAxes.native(d)),
                 kFloat * test::irradiance_size(light), text);
  }
}

TEST(ProfileModels, Zh3IsWhatItsFormSays) {
  const Coefficients light = test::random_light(4);
  const Coefficients degree2 = [&] {
    Coefficients cut(2);
    for (int c = 0; c < kChannelCount; ++c) {
      std::copy_n(light.channels[c].begin(), 9, cut.channels[c].begin());
    }
    return cut;
  }();
  for (const std::string form : {"fitted", "hallucinated"}) {
    const std::string text = test::export_text("zh3", {{"zonal", form}}, light);
    const Coefficients expected =
        expand(form == "fitted" ? fit_zh3(degree2) : hallucinate_zh3(degree2));
    for (const Vec& d : test::hundred_directions()) {
      expect_equal(zh3_of(text, d), irradiance_of(expected, kAxes.native(d)),
                   kFloat * test::irradiance_size(light), form);
    }
  }
}

// A profile that shows zh without being ZH3 is refused, and so is ZH3 of another degree.
TEST(ProfileModels, ZonalNumbersNeedTheModel) {
  const std::string text =
      "shoal_profile: 1\ntitle: t\nconsumer: c\nframe: native\nsign: plain\nquantity: radiance\n"
      "degree: 2\nextension: txt\npacking: {zonal: [zh.r]}\ntext: '{{zonal}}'\n";
  const auto without = parse_profile(text, "mine.yaml");
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().text().find("zh is for light: zh3"), std::string::npos)
      << without.error().text();
  EXPECT_TRUE(parse_profile(text + "light: zh3\n", "mine.yaml"));
  std::string lower = text + "light: zh3\n";
  lower.replace(lower.find("degree: 2"), 9, "degree: 1");
  EXPECT_FALSE(parse_profile(lower, "mine.yaml"));
}

TEST(ProfileModels, ShadersGiveTheModels) {
#ifdef SHOAL_TEST_EGL
  const auto directions = test::hundred_directions();
  const Coefficients light = test::random_light(2);
  const struct {
    std::string profile;
    std::function<Vec(const Vec&)> expected;  // of a native direction
  } kCases[] = {
      {"zh3", [&](const Vec& d) { return irradiance_of(expand(fit_zh3(light)), d); }},
      {"l1-nonlinear", [&](const Vec& d) { return nonlinear_irradiance(light, d); }},
  };
  for (const auto& [profile, expected] : kCases) {
    const auto got = test::run_on_directions(test::export_text(profile, {}, light),
                                             "shoal_irradiance", directions);
    if (!got.error.empty()) GTEST_SKIP() << got.error;
    ASSERT_EQ(got.values.size(), directions.size()) << got.log;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      expect_equal(Vec(got.values[i]), expected(kAxes.native(directions[i])),
                   kShader * test::irradiance_size(light), profile);
    }
  }
#else
  GTEST_SKIP() << "built without EGL (Debian's libegl-dev)";
#endif
}

}  // namespace
}  // namespace shoal
