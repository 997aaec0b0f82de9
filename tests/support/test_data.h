// Where the real panoramas are, for tests that want them.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace shoal::test {

inline std::filesystem::path data_folder() {
  const char* folder = std::getenv("SHOAL_TEST_DATA");
  return folder ? folder : "";
}

}  // namespace shoal::test

// Skips the test, saying so, where the file or folder `relative` of the real panoramas is absent.
#define SHOAL_REQUIRE_TEST_DATA(relative)                                  \
  if (!std::filesystem::exists(shoal::test::data_folder() / (relative)) || \
      shoal::test::data_folder().empty())                                  \
  GTEST_SKIP() << "real panorama " << (relative) << " not found; set SHOAL_TEST_DATA"
