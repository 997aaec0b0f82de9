// Panoramas of a test's own, and what the program makes of them.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "library/program.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"

namespace shoal::viz::test {

using shoal::test::make_noisy_picture;
using shoal::test::TemporaryFolder;
using shoal::test::write_picture;

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// A folder in which `shoal` can be run, the one that is found in PATH as well.
class LibraryTest : public testing::Test {
 protected:
  LibraryTest() {
    const std::string place = std::filesystem::path(SHOAL_PROGRAM).parent_path().string();
    ::setenv("PATH", (place + ":/usr/bin:/bin").c_str(), 1);
  }

  Finished shoal(std::vector<std::string> arguments) {
    const auto finished = run_program(SHOAL_PROGRAM, arguments);
    EXPECT_TRUE(finished) << finished.error().text();
    return finished ? *finished : Finished();
  }

  // a.hdr, b.exr and c.hdr, and bad.hdr, which is none.
  void make_panoramas() {
    write_picture(make_noisy_picture(32, 16, 1), MapFormat::hdr, folder / "a.hdr");
    write_picture(make_noisy_picture(64, 32, 2), MapFormat::exr_half, folder / "b.exr");
    write_picture(make_noisy_picture(48, 24, 3), MapFormat::hdr, folder / "c.hdr");
    write_text(folder / "bad.hdr", "no picture");
  }

  // Runs a manifest of these panoramas and further keys. Returns its output folder.
  std::filesystem::path run_manifest(const std::string& panoramas, const std::string& more = "",
                                     int exit_status = 0) {
    write_text(folder / "m.yaml", "shoal: 1\noutput: out\npanoramas: [" + panoramas + "]\n" + more);
    const Finished finished = shoal({"run", (folder / "m.yaml").string()});
    EXPECT_EQ(finished.exit_status, exit_status) << finished.err;
    return folder / "out";
  }

  // Runs one over make_panoramas(); c comes first.
  std::filesystem::path run_library(const std::string& more) {
    make_panoramas();
    return run_manifest(
        "{file: c.hdr, tags: [out, sun]}, {file: a.hdr}, {file: b.exr}, {file: bad.hdr}", more, 1);
  }

  TemporaryFolder folder;
};

}  // namespace shoal::viz::test
