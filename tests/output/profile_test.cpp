// The language of profiles: what it says, what it refuses and how, and what is compiled in.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "profile_support.h"
#include "support/temporary_folder.h"
#include "table_support.h"

namespace shoal {
namespace {

using ::testing::HasSubstr;

// A profile with the keys that all need, and more.
std::string profile_text(const std::string& more, const std::string& text = "{{numbers}}") {
  return "shoal_profile: 1\ntitle: Mine\nconsumer: mine\nframe: native\nsign: plain\n"
         "quantity: radiance\ndegree: 1\nextension: txt\n" +
         more + "text: |\n  " + text + "\n";
}

Profile parsed(const std::string& text) {
  auto profile = parse_profile(text, "mine.yaml");
  EXPECT_TRUE(profile) << profile.error().text();
  return profile ? std::move(*profile) : Profile{};
}

std::string fault(const std::string& text) {
  const auto profile = parse_profile(text, "folder/mine.yaml");
  return profile ? "no fault" : profile.error().text();
}

// Coefficient i of channel c is 10 i + c + 1.
Coefficients counting(int degree) {
  Coefficients light(degree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = 0; i < coefficient_count(degree); ++i) light.channels[c][i] = 10 * i + c + 1;
  }
  return light;
}

std::string written(const std::string& text, const Coefficients& light = counting(2)) {
  const auto file = write_profile_text(parsed(text), light, {"a/hall", "soft"});
  return file ? *file : file.error().text();
}

TEST(ProfileText, NumbersInterleavedPlanarAndOfOneChannel) {
  EXPECT_EQ(written(profile_text("")),
            "1.0, 2.0, 3.0, 11.0, 12.0, 13.0, 21.0, 22.0, 23.0, 31.0, 32.0, 33.0\n");
  EXPECT_EQ(written(profile_text("channels: planar\nseparator: \" \"\n")),
            "1.0 11.0 21.0 31.0 2.0 12.0 22.0 32.0 3.0 13.0 23.0 33.0\n");
  EXPECT_EQ(written(profile_text("order: [sh3, sh0]\n", "{{numbers.g}}|{{count}}")),
            "32.0, 2.0|2\n");
}

TEST(ProfileText, LinesRepeatForCoefficients) {
  EXPECT_EQ(written(profile_text("", "[\n  {{n}}: {{l}} {{m}} {{i}} {{r}};{{b}}{{,}}\n  ]")),
            "[\n0: 0 0 0 1.0;3.0,\n1: 1 -1 1 11.0;13.0,\n2: 1 0 2 21.0;23.0,\n"
            "3: 1 1 3 31.0;33.0\n]\n");
}

TEST(ProfileText, LinesRepeatForWhatIsUnknown) {
  const std::string more = "unknown: [\"that\", 'say \"x\"']\nsources: s\n";
  EXPECT_EQ(written(profile_text(more, "# {{unknown}}.\n  {{json.unknown}}\n  {{source}}")),
            "# that.\n# say \"x\".\n[\"that\", \"say \\\"x\\\"\"]\ns\n");
}

TEST(ProfileText, Facts) {
  EXPECT_EQ(written(profile_text("",
                                 "{{json.panorama}} {{variant}} {{profile}} {{title}} {{frame}} "
                                 "{{sign}} {{quantity}} {{basis}} {{degree}}")),
            "\"a/hall\" soft mine Mine -x,-y,+z plain radiance separate 1\n");
}

TEST(ProfileText, ALineEndInANameEndsNoComment) {
  const auto file =
      write_profile_text(parsed(profile_text("", "// {{panorama}}")), counting(1), {"a\nb", ""});
  EXPECT_EQ(*file, "// a?b\n");
}

TEST(ProfilePacking, Combinations) {
  const std::string more =
      "packing: {a: [sh0 - sh3, 2*sh1/4 + 1, -sh2], c: [\"sh3.r\", sh3.b, pi/pi, \"-2\"]}\n";
  // Green: 2 - 32, 12 / 2 + 1, -22.
  EXPECT_EQ(written(profile_text(more, "{{a.g}} / {{c}}")),
            "-30.0, 7.0, -22.0 / 31.0, 33.0, 1.0, -2.0\n");
}

TEST(ProfileConvention, SignScaleQuantityAndConstants) {
  Coefficients light(1);
  for (auto& channel : light.channels) channel = {1, 1, 1, 1};
  const std::string head =
      "shoal_profile: 1\ntitle: t\nconsumer: c\nframe: native\ndegree: 1\n"
      "extension: txt\nnumber: float64\ntext: \"{{numbers.r}}\"\n";
  EXPECT_EQ(written(head + "sign: condon-shortley\nquantity: radiance\nscale: [3, 1/2]\n", light),
            "3.0, -0.5, 0.5, -0.5\n");
  const double a1 = 2 * std::numbers::pi / 3;
  const double y1 = std::sqrt(3 / std::numbers::pi) / 2;
  const auto numbers =
      test::numbers_in("@" + written(head + "sign: plain\nquantity: irradiance\nbasis: "
                                            "premultiplied\nscale: 1/pi\n",
                                     light),
                       "@");
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_DOUBLE_EQ(numbers[0], std::sqrt(1 / std::numbers::pi) / 2);
  EXPECT_DOUBLE_EQ(numbers[3], a1 * y1 / std::numbers::pi);
}

// Native x of degree 1 is index 3; in a frame whose centre is +z, native -x points along +z,
// index 2.
TEST(ProfileConvention, FrameAsMapping) {
  Coefficients light(1);
  light.channels[0] = {0, 0, 0, 1};
  std::string text = profile_text("", "{{numbers.r}}");
  text.replace(text.find("native"), 6, "{center: +z, right: -x, up: +y}");
  EXPECT_EQ(written(text, light), "0.0, 0.0, -1.0, 0.0\n");
}

TEST(ProfileDegree, LowerIsRefusedAndHigherIsCut) {
  const Profile profile = parsed(profile_text(""));
  const auto low = write_profile_text(profile, counting(0), {"hall", ""});
  ASSERT_FALSE(low);
  EXPECT_EQ(low.error().code, ErrorCode::usage);
  EXPECT_EQ(
      low.error().text(),
      "hall: the profile mine needs degree 1, and its coefficients end at degree 0 (project it "
      "to degree 1)");
  EXPECT_EQ(*write_profile_text(profile, counting(5), {"", ""}),
            *write_profile_text(profile, counting(1), {"", ""}));
}

TEST(ProfileNumbers, ReadBackExactly) {
  Coefficients light = test::random_light(2);
  for (const std::string type : {"float32", "float64"}) {
    const auto numbers = test::numbers_in(
        "@" + written(profile_text("number: " + type + "\n", "{{numbers.r}}"), light), "@");
    ASSERT_EQ(numbers.size(), 4u);
    for (int i = 0; i < 4; ++i) {
      const double value = light.channels[0][i];
      if (type == "float32") {
        EXPECT_EQ(static_cast<float>(numbers[i]), static_cast<float>(value));
      } else {
        EXPECT_EQ(numbers[i], value);
      }
    }
  }
}

TEST(ProfileNumbers, WhatIsNoFloat32IsRefused) {
  Coefficients light(1);
  light.channels[1][2] = 1e39;
  EXPECT_THAT(written(profile_text(""), light), HasSubstr("1e+39, too large for a float32"));
  EXPECT_THAT(written(profile_text("number: float64\n"), light),
              HasSubstr("9.9999999999999994e+38"));
  light.channels[1][2] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(written(profile_text("number: float64\n"), light), HasSubstr("is not finite"));
}

TEST(ProfileNpy, PlanarDoubles) {
  const std::string text =
      "shoal_profile: 1\ntitle: t\nconsumer: c\nframe: native\nsign: plain\nquantity: radiance\n"
      "degree: 1\nform: npy\nnumber: float64\nchannels: planar\n";
  const std::string file = written(text);
  EXPECT_THAT(file, HasSubstr("'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }"));
  ASSERT_EQ(file.size(), 128u + 12 * sizeof(double));
  double second = 0;
  std::memcpy(&second, file.data() + 128 + sizeof(double), sizeof second);
  EXPECT_EQ(second, 11.0);
}

// Every message has its place and says what to do.
TEST(ProfileFaults, AreToldWithTheirPlace) {
  EXPECT_EQ(fault(profile_text("sgin: plain\n")),
            "folder/mine.yaml:9:1: unknown key \"sgin\" in a profile (did you mean \"sign\"?)");
  EXPECT_EQ(fault(profile_text("number: float\n")),
            "folder/mine.yaml:9:9: number must be float32 or float64, not \"float\" (did you mean "
            "\"float32\"?)");
  EXPECT_EQ(fault(profile_text("scale: [1, 2, 3]\n")),
            "folder/mine.yaml:9:8: scale has 3 factors for 2 degrees (give one for each degree, or "
            "one for all)");
  EXPECT_EQ(
      fault(profile_text("scale: 1/e\n")),
      "folder/mine.yaml:9:10: a number or a coefficient is missing here (factors look like 2, "
      "1/pi or 2*pi/3)");
  EXPECT_EQ(fault(profile_text("packing:\n  a: [sh0, sh1 - sh7]\n")),
            "folder/mine.yaml:10:18: the coefficients are sh0 to sh3 (terms look like sh6, 3*sh6, "
            "-sh1.r/2, or are plain numbers)");
  EXPECT_EQ(fault(profile_text("order: [sh0, 2*sh1]\n")),
            "folder/mine.yaml:9:14: order lists coefficients as they are (order: [sh0, sh3, sh1]; "
            "combinations go under packing)");
  EXPECT_EQ(fault(profile_text("order: [sh0, sh1, sh0]\n")),
            "folder/mine.yaml:9:19: sh0 stands in the order already (order: [sh0, sh3, sh1]; each "
            "coefficient once)");
  EXPECT_EQ(
      fault(profile_text("", "a\n  bc {{pnorama}}")),
      "folder/mine.yaml:11:6: nothing is called \"pnorama\" here (did you mean {{panorama}}?)");
  EXPECT_EQ(
      fault(profile_text("packing: {a: [sh0]}\n", "{{a}}")),
      "folder/mine.yaml:11:3: the list \"a\" cannot stand here as {{a}} (say of which channel: "
      "{{a.r}})");
  EXPECT_EQ(fault(profile_text("packing: {frame: [sh0]}\n")),
            "folder/mine.yaml:9:11: \"frame\" cannot be a list's name (a text has a place of that "
            "name already)");
  EXPECT_EQ(fault(profile_text("unknown: much\n")),
            "folder/mine.yaml:9:1: the text does not show what is unknown (give it a line with "
            "{{unknown}}, or {{json.unknown}} in JSON)");
  EXPECT_EQ(fault("shoal_profile: 1\ntitle: t\n"),
            "folder/mine.yaml:1:1: a profile needs the key \"consumer\" "
            "(manifests/profiles/README.md tells every key)");
  EXPECT_EQ(fault("title: [a\n").substr(0, 19), "folder/mine.yaml:2:");
}

TEST(ProfileFaults, OfOptions) {
  const std::string option =
      "options: {kind: {default: b, choices: {a: {quantity: irradiance}}}}\n";
  EXPECT_EQ(fault(profile_text(option)), "folder/mine.yaml:9:27: \"b\" is none of the choices");
  EXPECT_THAT(fault(profile_text("options: {kind: {default: a, choices: {a: {degree: 1}}}}\n")),
              HasSubstr("unknown key \"degree\" in a choice"));
  const std::string good =
      profile_text("options: {kind: {default: a, choices: {a: {}, b: {scale: 2}}}}\n",
                   "{{option.kind}} {{numbers.r}}");
  const Profile profile = parsed(good);
  EXPECT_EQ(*write_profile_text(profile, counting(1), {"", ""}), "a 1.0, 11.0, 21.0, 31.0\n");
  const test::Options b = {{"kind", "b"}};
  EXPECT_EQ(*write_profile_text(*with_options(profile, b), counting(1), {"", ""}),
            "b 2.0, 22.0, 42.0, 62.0\n");
  const test::Options wrong_name = {{"knid", "b"}};
  EXPECT_THAT(with_options(profile, wrong_name).error().text(), HasSubstr("did you mean \"kind\""));
  const test::Options wrong_word = {{"kind", "c"}};
  EXPECT_THAT(with_options(profile, wrong_word).error().text(),
              HasSubstr("no choice of kind is called \"c\""));
  EXPECT_NE(profile_fingerprint(profile), profile_fingerprint(*with_options(profile, b)));
}

TEST(ProfileNames, AreSuggested) {
  const auto profile = find_profile("untiy");
  ASSERT_FALSE(profile);
  EXPECT_THAT(profile.error().text(), HasSubstr("did you mean \"unity\"?"));
}

TEST(ProfileNames, AFileOfTheUsers) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "mine.yaml") << profile_text("");
  const auto profile = find_profile((folder / "mine.yaml").string());
  ASSERT_TRUE(profile) << profile.error().text();
  EXPECT_EQ(profile->name, "mine");
  EXPECT_EQ(find_profile((folder / "other.yaml").string()).error().code, ErrorCode::not_found);
}

// What is compiled in are the files of manifests/profiles/, byte by byte; all say what they know
// from where, and show what they do not know in what they write.
TEST(BuiltinProfiles, AreTheFiles) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SHOAL_PROFILES)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  const auto builtin = builtin_profile_names();
  EXPECT_EQ(names, std::vector<std::string>(builtin.begin(), builtin.end()));
  for (const std::string& name : names) {
    const auto profile = find_profile(name);
    ASSERT_TRUE(profile) << profile.error().text();
    EXPECT_EQ(profile->name, name);
    EXPECT_EQ(profile->data,
              test::bytes_of(std::filesystem::path(SHOAL_PROFILES) / (name + ".yaml")));
    EXPECT_FALSE(profile->sources.empty()) << name;
    const std::string file = test::export_text(name, {}, test::random_light(4));
    for (const std::string& unknown : profile->unknown) EXPECT_THAT(file, HasSubstr(unknown));
  }
}

TEST(ProfileReadme, TellsEveryKeyPlaceAndProfile) {
  std::stringstream text;
  text << std::ifstream(std::filesystem::path(SHOAL_PROFILES) / "README.md").rdbuf();
  const std::string readme = text.str();
  for (const std::string_view key : profile_keys()) {
    EXPECT_THAT(readme, HasSubstr("| `" + std::string(key) + "` |"));
  }
  for (const std::string_view fact : profile_facts()) {
    EXPECT_THAT(readme, HasSubstr("`{{" + std::string(fact) + "}}`"));
  }
  for (const std::string_view name : builtin_profile_names()) {
    EXPECT_THAT(readme, HasSubstr("| `" + std::string(name) + "` |"));
  }
}

}  // namespace
}  // namespace shoal
