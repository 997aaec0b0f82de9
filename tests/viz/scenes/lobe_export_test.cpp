#include "scenes/lobe_export.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "scenes/lobe.h"
#include "viz/scenes/made_library.h"

namespace shoal::viz {
namespace {

class LobeExport : public testing::Test {
 protected:
  std::string written(const std::string& name) {
    const auto path = std::filesystem::path(testing::TempDir()) / ("shoal-" + name);
    const Status status = write_lobes(input(), path);
    EXPECT_TRUE(status) << status.error().text();
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    std::filesystem::remove(path);
    return text.str();
  }

  SceneInput input() { return {&library_, 0, std::nullopt, settings_, &pixels_}; }

  Library library_ = test::made_library();
  SceneSettings settings_;
  PixelCache pixels_{library_};
};

std::uint32_t word(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

// Section 4.4 of the specification: a header of 12 bytes, then chunks of a length, a type and as
// many bytes, all multiples of 4.
TEST_F(LobeExport, GlbIsMadeOfItsTwoChunks) {
  const std::string glb = written("lobes.glb");
  ASSERT_GT(glb.size(), 28u);
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(glb, 4), 2u);
  EXPECT_EQ(word(glb, 8), glb.size());
  const std::uint32_t json_size = word(glb, 12);
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(glb[20], '{');
  const std::uint32_t binary_size = word(glb, 20 + json_size);
  EXPECT_EQ(glb.substr(24 + json_size, 4), std::string("BIN\0", 4));
  EXPECT_EQ(28 + json_size + binary_size, glb.size());

  const Lobe lobe = make_lobe(library_.panoramas[0], settings_, kFineRings);
  const std::size_t vertices = lobe.mesh.positions.size();
  EXPECT_EQ(binary_size, 36 * vertices + 12 * lobe.mesh.triangles.size());
  EXPECT_EQ(std::memcmp(glb.data() + 28 + json_size, lobe.mesh.positions.data(), 12 * vertices), 0);
  EXPECT_EQ(std::memcmp(glb.data() + 28 + json_size + 36 * vertices, lobe.mesh.triangles.data(),
                        12 * lobe.mesh.triangles.size()),
            0);
}

TEST_F(LobeExport, IsTheSameTwice) {
  for (const char* name : {"a.glb", "a.gltf", "a.vtp"}) EXPECT_EQ(written(name), written(name));
}

TEST_F(LobeExport, NodeTurnsUpAndCentreToGltfs) {
  for (const FrameAlias& alias : frame_aliases()) {
    settings_.frame = alias.frame;
    const std::string json = written("turned.gltf");
    const std::size_t place = json.find("\"rotation\": [");
    ASSERT_NE(place, std::string::npos);
    glm::dquat q;
    ASSERT_EQ(std::sscanf(json.c_str() + place, "\"rotation\": [%lf, %lf, %lf, %lf]", &q.x, &q.y,
                          &q.z, &q.w),
              4);
    EXPECT_LT(glm::distance(q * direction_of(alias.frame.up), {0.0, 1.0, 0.0}), 1e-6) << alias.name;
    EXPECT_LT(glm::distance(q * direction_of(alias.frame.center), {0.0, 0.0, 1.0}), 1e-6)
        << alias.name;
  }
}

TEST_F(LobeExport, VtpNamesItsArrays) {
  const std::string vtp = written("lobes.vtp");
  for (const char* part : {"PolyData", "Name=\"normal\"", "Name=\"colour\"", "Name=\"value\""}) {
    EXPECT_NE(vtp.find(part), std::string::npos) << part;
  }
}

TEST_F(LobeExport, RefusesAnotherExtension) {
  const Status status = write_lobes(input(), "lobes.obj");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().text(),
            "lobes.obj: lobes cannot be written as \".obj\" (name a file that ends in .vtp, .gltf "
            "or .glb)");
}

}  // namespace
}  // namespace shoal::viz
