// exports: in manifests and in runs.
#include <gmock/gmock.h>

#include "library_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Key;
using ::testing::UnorderedElementsAre;

class Exports : public test::LibraryTest {
 protected:
  // The keys below exports/ of what a run wrote.
  std::map<std::string, std::string> exports() {
    std::map<std::string, std::string> found;
    for (auto& [name, content] : outputs()) {
      if (name.starts_with("exports/")) found[name.substr(8)] = content;
    }
    return found;
  }

  static std::string one(const std::string& more) {
    return "shoal: 1\noutput: out\npanoramas: [{file: a.hdr}]\n" + more;
  }

  static constexpr const char* kMine =
      "shoal_profile: 1\ntitle: t\nconsumer: c\nframe: native\nsign: plain\nquantity: radiance\n"
      "degree: 0\nextension: txt\ntext: \"{{panorama}}/{{variant}} {{numbers}}\"\n";
};

TEST_F(Exports, AreWrittenForEveryPanoramaAndVariant) {
  write_three();
  run(library("exports: [three, {profile: gltf, options: {convolved: \"no\"}, suffix: raw}]\n"));
  EXPECT_THAT(exports(), UnorderedElementsAre(Key("a.three.json"), Key("b.three.json"),
                                              Key("c.three.json"), Key("a.gltf.raw.json"),
                                              Key("b.gltf.raw.json"), Key("c.gltf.raw.json")));
  EXPECT_THAT(exports()["b.gltf.raw.json"], HasSubstr("\"convolved\": \"no\""));
  remove_outputs();
  run(library("exports: three\nvariants: {plain: , dark: {exposure: -1}}\n"));
  EXPECT_THAT(exports(), UnorderedElementsAre(Key("a.plain.three.json"), Key("b.plain.three.json"),
                                              Key("c.plain.three.json"), Key("a.dark.three.json"),
                                              Key("b.dark.three.json"), Key("c.dark.three.json")));
}

// A profile of float64 shows that the light is the variant's, to the bit: half of a double is
// exact.
TEST_F(Exports, HoldTheLightOfTheVariantInTheProfilesFrame) {
  write_panorama("a.hdr", 1);
  std::string mine = kMine;
  mine.replace(mine.find("extension"), 0, "number: float64\n");
  write("mine.yaml", mine);
  run(
      one("exports: [./mine.yaml]\ntables: csv\nquantities: radiance\n"
          "variants: {plain: {frame: openexr}, dark: {exposure: -1}}\n"));
  const auto files = exports();
  const auto numbers = [](const std::string& text) {
    std::istringstream stream(text.substr(text.find(' ')));
    std::vector<double> values(3);
    std::string number;
    for (double& value : values) {
      stream >> number;
      value = std::stod(number);
    }
    return values;
  };
  const std::vector<double> plain = numbers(files.at("a.plain.mine.txt"));
  const std::vector<double> dark = numbers(files.at("a.dark.mine.txt"));
  EXPECT_THAT(files.at("a.dark.mine.txt"), testing::StartsWith("a/dark "));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(dark[c], plain[c] / 2);
  EXPECT_THAT(table(), HasSubstr("a,plain,radiance,0,0," + [&] {
                std::string rgb;
                for (const double value : plain) {
                  char digits[40];
                  std::snprintf(digits, sizeof digits, "%.17g", value);
                  rgb += (rgb.empty() ? "" : ",") + std::string(digits);
                }
                return rgb;
              }()));
}

TEST_F(Exports, AreUpToDateUntilWhatTheyDependOnChanges) {
  write_panorama("a.hdr", 1);
  write("mine.yaml", kMine);
  const std::string manifest = one("exports: [mine.yaml]\n");
  const auto reason = [&](const std::string& text) { return plan(text).reasons["a"]; };
  run(manifest);
  const auto before = exports();
  EXPECT_EQ(reason(manifest), "up to date");
  for (const std::string changed :
       {"exports: [{profile: mine.yaml, suffix: x}]\n", "exports: [three]\n", "maps: []\n",
        "exports: [{profile: mine.yaml, frame: openexr}]\n"}) {
    EXPECT_EQ(reason(one(changed)), "its outputs are asked for differently") << changed;
  }
  write("mine.yaml", std::string(kMine) + "separator: \" \"\n");
  EXPECT_EQ(reason(manifest), "its outputs are asked for differently");
  run(manifest);
  EXPECT_NE(exports(), before);
  write("mine.yaml", kMine);
  run(manifest);
  EXPECT_EQ(exports(), before);
  std::filesystem::remove(folder_ / "out/exports/a.mine.txt");
  EXPECT_EQ(reason(manifest), "a file that it wrote is missing or has another size");
}

TEST_F(Exports, AreTheSameWhateverElseIsAsked) {
  write_three();
  run(library("exports: [numpy]\n"));
  const auto alone = exports();
  remove_outputs();
  run(library("exports: [numpy, unity, cesium]\nmaps: [{kind: radiance, size: [8, 4]}]\n"));
  const auto together = exports();
  for (const auto& [name, content] : alone) EXPECT_EQ(together.at(name), content) << name;
}

TEST_F(Exports, ThatAreWrongAreToldWithTheirPlace) {
  touch({"a.hdr"});
  write("mine.yaml", "shoal_profile: 1\ntilte: t\n");
  EXPECT_EQ(messages(one("exports: [tree, mine.yaml, {profile: three, quantity: radiance}]\n")),
            R"(m.yaml:4:11: error: no profile is called "tree"
    exports: [tree, mine.yaml, {profile: three, quantity: radiance}]
              ^ did you mean "three"?; a file of your own is named with its .yaml
m.yaml:4:17: error: mine.yaml:2:1: unknown key "tilte" in a profile
    exports: [tree, mine.yaml, {profile: three, quantity: radiance}]
                    ^ did you mean "title"?
m.yaml:4:45: error: unknown key "quantity" in an export
    exports: [tree, mine.yaml, {profile: three, quantity: radiance}]
                                                ^ known here: profile, options, frame, suffix
)");
  EXPECT_EQ(messages(one("exports: [{profile: gltf, options: {convolvd: \"no\", sign: plane}}]\n")),
            R"(m.yaml:4:37: error: no option of the profile gltf is called "convolvd"
    exports: [{profile: gltf, options: {convolvd: "no", sign: plane}}]
                                        ^ did you mean "convolved"?
m.yaml:4:53: error: no choice of sign is called "plane"
    exports: [{profile: gltf, options: {convolvd: "no", sign: plane}}]
                                                        ^ did you mean "plain"?
)");
  EXPECT_EQ(messages(one("exports: [three, three, cmft]\n")),
            R"(m.yaml:4:18: error: two exports would be written to "exports/NAME.three.json"
    exports: [three, three, cmft]
                     ^ give one a suffix; the first is on line 4
m.yaml:4:25: error: the profile cmft needs degree 4, but "a" has 2
    exports: [three, three, cmft]
                            ^ give it degree: 4
)");
  EXPECT_THAT(messages(one("exports: {three: unity}\n")), HasSubstr("must be a list of profiles"));
  EXPECT_THAT(messages(one("exports: [gone.yaml]\n")), HasSubstr("gone.yaml"));
}

TEST_F(Exports, OfIncludedManifestsAreReplaced) {
  touch({"a.hdr"});
  write("other/base.yaml", "shoal: 1\nexports: [unity, mine.yaml]\n");
  write("other/mine.yaml", kMine);
  const auto names = [](const ManifestResult& result) {
    std::vector<std::string> found;
    if (!result.manifest) return std::vector{result.messages};
    for (const ExportRequest& request : result.manifest->exports) {
      found.push_back(request.profile->name);
    }
    return found;
  };
  EXPECT_THAT(names(load(one("include: other/base.yaml\n"))), ElementsAre("unity", "mine"));
  EXPECT_THAT(names(load(one("include: other/base.yaml\nexports: [three]\n"))),
              ElementsAre("three"));
}

}  // namespace
}  // namespace shoal
