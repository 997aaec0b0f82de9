#include "image/face_files.h"

#include <gmock/gmock.h>

#include <fstream>

#include "support/temporary_folder.h"

namespace shoal {
namespace {

using testing::ElementsAre;

std::vector<std::string> names_of(const std::filesystem::path& path) {
  std::vector<std::string> names;
  const auto paths = face_paths(path);
  for (int face = 0; paths && face < kFaceCount; ++face) names.push_back((*paths)[face].string());
  return names;
}

TEST(FaceFiles, AreToldByTheNameOfAnyOfThem) {
  EXPECT_THAT(names_of("a/sky_px.hdr"),
              ElementsAre("a/sky_px.hdr", "a/sky_nx.hdr", "a/sky_py.hdr", "a/sky_ny.hdr",
                          "a/sky_pz.hdr", "a/sky_nz.hdr"));
  EXPECT_EQ(names_of("a/sky_nz.hdr"), names_of("a/sky_px.hdr"));
  EXPECT_THAT(names_of("posx.jpg"),
              ElementsAre("posx.jpg", "negx.jpg", "posy.jpg", "negy.jpg", "posz.jpg", "negz.jpg"));
  EXPECT_THAT(names_of("b-FRONT.exr"), ElementsAre("b-RIGHT.exr", "b-LEFT.exr", "b-UP.exr",
                                                   "b-DOWN.exr", "b-FRONT.exr", "b-BACK.exr"));
  EXPECT_THAT(names_of("map.cube.Top.exr"),
              ElementsAre("map.cube.Right.exr", "map.cube.Left.exr", "map.cube.Top.exr",
                          "map.cube.Bottom.exr", "map.cube.Front.exr", "map.cube.Back.exr"));
  EXPECT_THAT(names_of("CubeNegz.hdr"),
              ElementsAre("CubePosx.hdr", "CubeNegx.hdr", "CubePosy.hdr", "CubeNegy.hdr",
                          "CubePosz.hdr", "CubeNegz.hdr"));
}

TEST(FaceFiles, NeedAWordOfTheirOwn) {
  for (const char* name : {"sky.hdr", "expx.hdr", "px_sky.hdr", "px1.hdr", "setup.hdr", ".hdr",
                           "sky_pX.hdr", "SKYPosx.hdr"}) {
    EXPECT_EQ(face_paths(name), std::nullopt) << name;
  }
}

// "right" is a word of two rows; the files say which.
TEST(FaceFiles, FollowTheFilesWhereTwoRowsFit) {
  const test::TemporaryFolder folder;
  const auto has_top = [&] {
    return (*face_paths(folder / "right.exr"))[2].filename() == "top.exr";
  };
  EXPECT_FALSE(has_top());
  for (const char* name : {"right", "left", "top", "bottom", "front"}) {
    std::ofstream(folder / (std::string(name) + ".exr")) << "x";
  }
  EXPECT_FALSE(has_top()) << "back is missing";
  EXPECT_EQ(existing_face_paths(folder / "right.exr"), std::nullopt);
  std::ofstream(folder / "back.exr") << "x";
  EXPECT_TRUE(has_top());
  EXPECT_TRUE(existing_face_paths(folder / "front.exr"));
}

}  // namespace
}  // namespace shoal
