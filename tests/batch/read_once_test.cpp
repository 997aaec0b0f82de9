// Whatever is asked of a panorama, its file is read once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "library_folder.h"

namespace shoal {
namespace {

using ReadOnce = test::LibraryTest;

// Bytes that this process has asked of files, by proc(5).
std::uint64_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string name;
  std::uint64_t count = 0;
  io >> name >> count;
  EXPECT_EQ(name, "rchar:");
  return count;
}

// What a run reads besides, tables and small outputs that are hashed, is far less than the file; a
// second decoding would be all of it again. By one worker: of several, what comes out of the file's
// order is read again for its hash.
TEST_F(ReadOnce, ByVariantsViewsMapsExportsFiguresSunAndClamp) {
  write_panorama("lib/a.hdr", 1, 1024, 512);
  const auto size = std::filesystem::file_size(folder_ / "lib/a.hdr");
  ASSERT_GT(size, 1'000'000U);
  RunOptions one_worker;
  one_worker.threads = 1;
  const std::uint64_t before = bytes_read();
  const Ran ran =
      run(library("defaults: {degree: 3, quality: 12, sun: {top: 0.001, action: replace}, clamp: "
                  "{percentile: 99.9}}\n"
                  "variants: {plain: {}, dark: {exposure: -2}, soft: {window: auto}, rest: "
                  "{dominant: remove}, set: {views: 4}}\n"
                  "quantities: [radiance, irradiance]\ntables: [csv, json, npy, quality, lights]\n"
                  "maps: [{kind: irradiance, size: [16, 8]}, {kind: radiance, layout: cube, size: "
                  "8}]\nexports: [three, gltf]\n"),
          one_worker);
  const std::uint64_t read = bytes_read() - before;
  EXPECT_EQ(ran.summary.done_count, 1);
  EXPECT_EQ(ran.summary.export_count, 8 * 2);
  EXPECT_GE(read, size);
  EXPECT_LT(read, size + size / 2);
}

}  // namespace
}  // namespace shoal
