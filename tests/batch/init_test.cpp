#include "batch/init.h"

#include <gmock/gmock.h>

#include "manifest_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class InitTest : public test::ManifestTest {};

TEST_F(InitTest, RunsAsItIs) {
  touch({"b.hdr", "sub/a.EXR", "sub/c.hdr", "notes.txt", "preview.png", ".hidden/d.hdr"});
  const Result<std::string> text = initial_manifest(folder_.path());
  ASSERT_TRUE(text.ok()) << text.error().text();
  EXPECT_THAT(*text, HasSubstr("# Found here when this manifest was made: 1 .EXR, 2 .hdr."));
  write(std::string(kInitialManifestName), *text);
  const ManifestResult result = load_file(std::string(kInitialManifestName));
  EXPECT_EQ(result.messages, "");
  EXPECT_THAT(names(result), ElementsAre("b", "sub/a", "sub/c"));
}

// What is commented out must be right as well: every line that holds YAML behind its '#' is tried.
TEST_F(InitTest, CommentedLinesAreRight) {
  touch({"b.hdr", "studio.exr"});
  std::string text = *initial_manifest(folder_.path());
  const std::pair<std::string, std::string> uncommented[] = {
      {"    # exclude: \"*_thumb*\"", "    exclude: \"studio*\""},
      {"    # tags:", "    tags:"},
      {"    # exposure:", "    exposure:"},
      {"  # - {file:", "  - {file:"},
      {"# variants:", "variants:"},
      {"#   plain:", "  plain:"},
      {"#   dark:", "  dark:"},
      {"  # - {kind: radiance", "  - {kind: radiance"},
      {"  # - {kind: irradiance", "  - {kind: irradiance"}};
  for (const auto& [from, to] : uncommented) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  const ManifestResult result = load(text);
  EXPECT_EQ(result.messages, "");
  EXPECT_THAT(names(result), ElementsAre("b", "key-light"));
  ASSERT_TRUE(result.manifest);
  EXPECT_EQ(result.manifest->maps.size(), 3u);
  EXPECT_EQ(result.manifest->variants.size(), 2u);
}

TEST_F(InitTest, OneKindInOneFolder) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_THAT(*initial_manifest(folder_.path()), HasSubstr("- files: \"*.hdr\"\n"));
}

TEST_F(InitTest, OrdinaryPicturesOnlyWithoutOthers) {
  touch({"a.jpg", "b.png"});
  EXPECT_THAT(*initial_manifest(folder_.path()), HasSubstr("- files: \"*.{jpg,png}\"\n"));
  touch({"c.exr"});
  EXPECT_THAT(*initial_manifest(folder_.path()), HasSubstr("- files: \"*.exr\"\n"));
}

TEST_F(InitTest, NothingToTake) {
  touch({"notes.txt"});
  const Result<std::string> none = initial_manifest(folder_.path());
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::not_found);
  EXPECT_EQ(none.error().what, "no panorama lies here or in a folder below");
  EXPECT_EQ(initial_manifest(folder_ / "notes.txt").error().what, "is not a folder");
  EXPECT_EQ(initial_manifest(folder_ / "nowhere").error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace shoal
