// The shader functions that profiles write: compiled, and run on a GPU or on Mesa's model of one.
#include <gtest/gtest.h>

#include <optional>

#include "profile_support.h"
#include "python.h"
#include "support/temporary_folder.h"

#ifdef SHOAL_TEST_EGL
#include "compute_shader.h"
#endif

namespace shoal {
namespace {

constexpr const char* kGlslang = SHOAL_TEST_GLSLANG;

#define SHOAL_REQUIRE_GLSLANG()                                                         \
  if (*kGlslang == '\0') {                                                              \
    GTEST_SKIP() << "no glslangValidator (Debian's glslang-tools) when this was built"; \
  }

// Compiles a file with glslangValidator, which picks the stage by the last extension.
void expect_compiles(const std::string& source, const std::string& file,
                     const std::string& arguments) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / file, source));
  const auto run = test::run_shell("'" + std::string(kGlslang) + "' " + arguments + " '" +
                                   (folder / file).string() + "'");
  EXPECT_EQ(run.status, 0) << run.output << "\n" << source;
}

std::string snippet(const std::string& profile) {
  return test::export_text(profile, {}, test::random_light(2));
}

constexpr const char* kGlslMain =
    "in vec3 normal;\nout vec4 colour;\nvoid main() { colour = vec4(shoal_irradiance(normal), "
    "1.0); }\n";

TEST(ProfileShaders, GlslCompilesForDesktopAndEs) {
  SHOAL_REQUIRE_GLSLANG();
  for (const std::string profile : {"glsl", "ramamoorthi", "zh3", "l1-nonlinear"}) {
    expect_compiles("#version 330\n" + snippet(profile) + kGlslMain, "a.frag", "");
    expect_compiles("#version 300 es\nprecision highp float;\n" + snippet(profile) + kGlslMain,
                    "a.frag", "");
  }
}

TEST(ProfileShaders, HlslCompiles) {
  SHOAL_REQUIRE_GLSLANG();
  expect_compiles(snippet("hlsl") +
                      "float4 main(float3 n : NORMAL) : SV_Target {\n"
                      "  return float4(shoal_irradiance(n), 1.0);\n}\n",
                  "a.frag", "-D -V -e main -o /dev/null");
}

// The compiler is one that fails: without a semicolon nothing compiles.
TEST(ProfileShaders, TheCompilerFindsFaults) {
  SHOAL_REQUIRE_GLSLANG();
  const test::TemporaryFolder folder;
  const std::string source = "#version 330\n" + snippet("glsl") + "void main() { oops }\n";
  ASSERT_TRUE(write_file_atomically(folder / "a.frag", source));
  const auto run =
      test::run_shell("'" + std::string(kGlslang) + "' '" + (folder / "a.frag").string() + "'");
  EXPECT_NE(run.status, 0);
}

// Twenty float operations on numbers that sum to `size` in magnitude, 6e-8 each: 2e-6 is above what
// they can lose together with the numbers' own rounding.
TEST(ProfileShaders, GlslGivesOurIrradiance) {
#ifdef SHOAL_TEST_EGL
  const struct {
    std::string profile;
    test::Axes axes;
  } kCases[] = {{"glsl", {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}},
                {"ramamoorthi", {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}};
  const auto directions = test::hundred_directions();
  const Coefficients light = test::random_light(2);
  for (const auto& [profile, axes] : kCases) {
    const auto got = test::run_on_directions(test::export_text(profile, {}, light),
                                             "shoal_irradiance", directions);
    if (!got.error.empty()) GTEST_SKIP() << got.error;
    ASSERT_EQ(got.values.size(), directions.size()) << got.log;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const glm::dvec3 expected = test::irradiance_at(light, 2, axes, directions[i]);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(got.values[i][c], expected[c], 2e-6 * test::irradiance_size(light)) << profile;
      }
    }
  }
#else
  GTEST_SKIP() << "built without EGL (Debian's libegl-dev)";
#endif
}

}  // namespace
}  // namespace shoal
