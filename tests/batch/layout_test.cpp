// Panoramas of six files, and maps in every layout, through whole runs.
#include <cmath>

#include "batch/library_folder.h"
#include "batch/verify.h"
#include "core/content_hash.h"
#include "output/coefficient_table.h"
#include "transform/projector.h"

namespace shoal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kFaces[] = {"px", "nx", "py", "ny", "pz", "nz"};
constexpr const char* kSix =
    "shoal: 1\noutput: out\npanoramas: [{file: lib/sky_px.hdr, layout: cube-faces}]\n";

class LayoutTest : public test::LibraryTest {
 protected:
  void write_faces() {
    for (int face = 0; face < 6; ++face) write_face(face, face + 1);
  }
  void write_face(int face, std::uint64_t seed) {
    write_panorama(std::string("lib/sky_") + kFaces[face] + ".hdr", seed, 16, 16);
  }
};

TEST_F(LayoutTest, APatternTakesSixFacesForOnePanorama) {
  write_faces();
  write_panorama("lib/other.hdr", 7);
  const auto found = [&](const std::string& layout) {
    return names(load("shoal: 1\npanoramas: [{files: 'lib/*.hdr', layout: " + layout + "}]\n"));
  };
  EXPECT_THAT(found("auto"), testing::ElementsAre("other", "sky_px"));
  EXPECT_EQ(found("equirect").size(), 7U);
  // A set that is not whole is no cube; six that are, but of which a pattern takes one, are.
  EXPECT_THAT(names(load("shoal: 1\npanoramas: [{files: 'lib/sky_n*.hdr', layout: auto}]\n")),
              testing::ElementsAre("sky_nx"));
  std::filesystem::remove(folder_ / "lib/sky_py.hdr");
  EXPECT_EQ(found("auto").size(), 6U);
}

// Each of the six counts: in the plan, in the store's hash, in `verify`.
TEST_F(LayoutTest, SixFilesAreOnePanorama) {
  write_faces();
  EXPECT_EQ(run(kSix).summary.done_count, 1);
  const auto before = outputs();
  EXPECT_EQ(run(kSix).summary.up_to_date_count, 1);
  PlanOptions by_content;
  by_content.inputs = PlanOptions::Inputs::by_content;
  EXPECT_EQ(plan(kSix, by_content).work.at("sky_px"), ItemWork::none);

  const std::atomic<bool> stop{false};
  VerifyOptions options;
  options.recompute = VerifyOptions::Recompute::yes;
  auto report = verify_outputs(folder_ / "out", options, stop);
  ASSERT_TRUE(report);
  EXPECT_THAT(report->problems, IsEmpty());
  EXPECT_EQ(report->recomputed_count, 1);

  write_face(3, 99);
  EXPECT_EQ(plan(kSix, by_content).reasons.at("sky_px"), "its file's content changed");
  report = verify_outputs(folder_ / "out", {}, stop);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->problems.size(), 1U);
  EXPECT_EQ(run(kSix).summary.done_count, 1);
  EXPECT_NE(outputs(), before);

  std::filesystem::remove(folder_ / "lib/sky_nz.hdr");
  const Ran failed = run(kSix);
  ASSERT_EQ(failed.summary.failures.size(), 1U);
  EXPECT_THAT(failed.summary.failures[0].text, HasSubstr("sky_nz.hdr"));
}

// Maps lie as their panorama does: each projects to nearly the same.
TEST_F(LayoutTest, MapsOfEveryLayoutAreTheSameLight) {
  write_panorama("lib/a.hdr", 1, 64, 32);
  const std::string maps = [] {
    std::string text = "maps:\n";
    for (const LayoutName& known : kLayoutNames) {
      const bool is_written = known.layout != Layout::automatic &&
                              known.layout != Layout::equirect &&
                              known.layout != Layout::cube_faces;
      if (!is_written) continue;
      text += "  - {kind: irradiance, size: 64, layout: " + std::string(known.name) + "}\n";
    }
    return text + "  - {kind: irradiance, layout: cube, size: 64, faces: files}\n";
  }();
  EXPECT_EQ(run(library(maps)).summary.map_count, 9 + 6);
  ProjectionTables tables;
  const auto read = [&](const std::string& name, Layout layout) {
    ProjectionSettings settings;
    settings.layout = layout;
    const auto result = project_panorama(folder_ / ("out/maps/" + name), {}, settings, tables);
    EXPECT_TRUE(result) << result.error().text();
    return result ? result->radiance.channels[1] : std::vector<double>(9);
  };
  const std::vector<double> expected = read("a.irradiance.octahedral.exr", Layout::octahedral);
  const auto expect_same = [&](const std::vector<double>& found, Layout layout) {
    const double most = (layout == Layout::mirror_ball ? 0.04 : 0.005) * expected[0];
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(found[i], expected[i], most) << name_of(layout);
  };
  for (const Layout layout :
       {Layout::cube_vertical_cross, Layout::cube_horizontal_cross, Layout::cube_vertical_strip,
        Layout::cube_horizontal_strip, Layout::cube_openexr, Layout::angular, Layout::mirror_ball,
        Layout::octahedral_equal_area}) {
    expect_same(read("a.irradiance." + std::string(name_of(layout)) + ".exr", layout), layout);
  }
  expect_same(read("a.irradiance.cube.px.exr", Layout::cube_faces), Layout::cube_faces);
}

// An envmap CUBE is read as one whatever is asked, and has OpenEXR's axes whatever the frame is:
// with another frame it stands as it was.
TEST_F(LayoutTest, AnOpenExrCubeTellsWhatItIs) {
  write_panorama("lib/a.hdr", 1, 64, 32);
  const std::string maps =
      "maps: [{kind: irradiance, size: 33, type: float, layout: cube-openexr}]\n";
  const std::filesystem::path file = folder_ / "out/maps/a.irradiance.cube-openexr.exr";
  EXPECT_EQ(run(library("defaults: {frame: \"+x,+y,+z\"}\n" + maps)).summary.map_count, 1);
  const auto before = hash_file(file);
  ASSERT_TRUE(before);
  ProjectionTables tables;
  const auto asked = [&](Layout layout) {
    ProjectionSettings settings;
    settings.layout = layout;
    const auto result = project_panorama(file, {}, settings, tables);
    EXPECT_TRUE(result) << result.error().text();
    return result ? result->radiance : Coefficients(2);
  };
  const Coefficients told = asked(Layout::cube_openexr);
  EXPECT_EQ(asked(Layout::automatic), told);
  EXPECT_EQ(asked(Layout::equirect), told);

  EXPECT_EQ(run(library("defaults: {frame: \"+z,+x,+y\"}\n" + maps)).summary.map_count, 0);
  const auto after = hash_file(file);
  ASSERT_TRUE(after);
  EXPECT_EQ(*after, *before);
}

}  // namespace
}  // namespace shoal
