#include "library/changed_pixels.h"

#include <gtest/gtest.h>

#include "sphere/turns.h"

namespace shoal::viz {
namespace {

// By whole columns, or upside down, a turn moves texels to where others were.
TEST(TurnedPixels, AreTheSameTexelsElsewhere) {
  Pixels pixels{8, 4, std::vector<float>(3 * 8 * 4)};
  for (std::size_t i = 0; i < pixels.rgb.size(); ++i) pixels.rgb[i] = static_cast<float>(i);
  const Pixels right = turned(pixels, *turn_matrix({90.0, 0.0, 0.0}));
  // About the axis through the picture's centre: rows and columns run the other way.
  const Pixels over = turned(pixels, *turn_matrix({0.0, 0.0, 180.0}));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 8; ++j) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(right.at(i, (j + 2) % 8)[c], pixels.at(i, j)[c], 1e-4) << i << ' ' << j;
        EXPECT_NEAR(over.at(3 - i, 7 - j)[c], pixels.at(i, j)[c], 1e-4) << i << ' ' << j;
      }
    }
  }
}

}  // namespace
}  // namespace shoal::viz
