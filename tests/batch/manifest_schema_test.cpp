// The JSON schema, the page that tells every key, the examples and the reader all say the same.
#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "batch/manifest_keys.h"
#include "manifest_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;

const std::filesystem::path kManifests = SHOAL_MANIFESTS;

// JSON is YAML; "#/$defs/NAME" is followed.
YAML::Node follow(const YAML::Node& schema, YAML::Node node) {
  while (node["$ref"]) {
    const std::string reference = node["$ref"].as<std::string>();
    node.reset(schema["$defs"][reference.substr(reference.rfind('/') + 1)]);
  }
  return node;
}

// The properties of each kind of mapping, as the schema has them.
std::map<std::string, YAML::Node> schema_mappings(const YAML::Node& schema) {
  const YAML::Node defs = schema["$defs"];
  return {{"manifest", schema["properties"]},
          {"defaults", defs["defaults"]["properties"]},
          {"panorama", defs["panorama"]["properties"]},
          {"variant", defs["variant"]["properties"]},
          {"map", defs["map"]["properties"]},
          {"export", defs["export"]["properties"]},
          {"clamp", defs["clamp"]["anyOf"][1]["properties"]},
          {"sun", defs["sun"]["anyOf"][0]["properties"]},
          {"frame", defs["frame"]["anyOf"][1]["properties"]},
          {"rotate", defs["rotate"]["anyOf"][0]["properties"]},
          {"window", defs["window"]["anyOf"][1]["properties"]},
          {"views", defs["views"]["properties"]},
          {"light", defs["light"]["properties"]},
          {"ambient", defs["ambient"]["properties"]},
          {"directional", defs["directional"]["properties"]},
          {"disk", defs["disk"]["properties"]},
          {"cosine", defs["cosine"]["properties"]},
          {"sky", defs["sky"]["properties"]},
          {"sky_sun", defs["sky_sun"]["properties"]},
          {"picture", defs["picture"]["properties"]}};
}

// The words of an enum at a node or in what it refers to, however deep.
void add_words(const YAML::Node& schema, const YAML::Node& raw, std::set<std::string>& words) {
  const YAML::Node node = follow(schema, raw);
  for (const auto& word : node["enum"]) words.insert(word.as<std::string>());
  for (const auto& option : node["anyOf"]) add_words(schema, option, words);
  if (node["items"]) add_words(schema, node["items"], words);
}

TEST(ManifestSchema, HasTheKeysOfTheReader) {
  const YAML::Node schema = YAML::LoadFile(kManifests / "shoal.schema.json");
  std::map<std::string, std::set<std::string>> of_schema;
  for (const auto& [mapping, properties] : schema_mappings(schema)) {
    for (const auto& property : properties) {
      of_schema[mapping].insert(property.first.as<std::string>());
    }
  }
  std::map<std::string, std::set<std::string>> of_reader;
  for (const ManifestKey& key : manifest_keys()) {
    of_reader[std::string(key.mapping)].insert(std::string(key.key));
  }
  EXPECT_EQ(of_schema, of_reader);
}

TEST(ManifestSchema, HasTheWordsOfTheReader) {
  const YAML::Node schema = YAML::LoadFile(kManifests / "shoal.schema.json");
  const auto mappings = schema_mappings(schema);
  for (const ManifestKey& key : manifest_keys()) {
    if (key.key == "shoal") continue;  // its enum is a number
    std::set<std::string> words;
    add_words(schema, mappings.at(std::string(key.mapping))[std::string(key.key)], words);
    EXPECT_EQ(words, (std::set<std::string>(key.choices.begin(), key.choices.end())))
        << key.mapping << " " << key.key;
  }
}

TEST(ManifestReadme, TellsEveryKeyAndWord) {
  std::stringstream text;
  text << std::ifstream(kManifests / "README.md").rdbuf();
  const std::string readme = text.str();
  for (const ManifestKey& key : manifest_keys()) {
    if (key.mapping == "frame") continue;  // told in an example
    EXPECT_NE(readme.find("`" + std::string(key.key) + "`"), std::string::npos) << key.key;
    for (const std::string_view word : key.choices) {
      EXPECT_NE(readme.find("`" + std::string(word) + "`"), std::string::npos) << word;
    }
  }
  for (const FrameAlias& alias : frame_aliases()) {
    EXPECT_NE(readme.find("`" + std::string(alias.name) + "`"), std::string::npos) << alias.name;
  }
}

class ManifestExamples : public test::ManifestTest {};

TEST_F(ManifestExamples, Quickstart) {
  touch({"city.exr", "courtyard.exr", "license.txt"});
  const ManifestResult result =
      load_manifest(kManifests / "quickstart.yaml", {.sets = {{"library", folder_.path()}}});
  EXPECT_EQ(result.messages, "");
  EXPECT_THAT(names(result), ElementsAre("city", "courtyard"));
}

TEST_F(ManifestExamples, Skies) {
  const ManifestResult result = load_manifest(kManifests / "skies.yaml");
  EXPECT_EQ(result.messages, "");
  EXPECT_THAT(names(result),
              ElementsAre("clear/1-dawn", "clear/2-early", "clear/3-morning", "clear/4-noon",
                          "hazy/1-dawn", "hazy/2-early", "hazy/3-morning", "hazy/4-noon"));
}

TEST_F(ManifestExamples, Studio) {
  touch({"outdoor/noon.hdr", "outdoor/noon_thumb.hdr", "outdoor/coast/dusk.exr",
         "outdoor/rejected/x.exr", "interior/hall.exr"});
  const ManifestResult result =
      load_manifest(kManifests / "studio.yaml", {.sets = {{"library", folder_.path()}}});
  EXPECT_EQ(result.messages, "");
  EXPECT_THAT(names(result), ElementsAre("coast/dusk", "noon", "hall"));
}

}  // namespace
}  // namespace shoal
