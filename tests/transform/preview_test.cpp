#include "transform/preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "transform/area_weights.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// Two roundings a product and one a sum, at most 34 of them in a row, of positive light.
constexpr double kRelativeError = 36 * 0x1p-24;

const std::atomic<bool> kGoOn{false};

Preview preview_of(const test::Picture& picture, int width,
                   MapFormat format = MapFormat::exr_float) {
  const test::TemporaryFolder folder;
  test::write_picture(picture, format, folder / "picture");
  auto preview = make_preview(folder / "picture", {}, {width}, kGoOn);
  EXPECT_TRUE(preview) << preview.error().text();
  return preview ? *preview : Preview();
}

// The solid angle of what both row [a/h, (a+1)/h) and row [b/k, (b+1)/k) of the sphere cover, for
// one radian of phi.
double shared_rows(int a, int h, int b, int k) {
  const double top = std::max(kPi * a / h, kPi * b / k);
  const double bottom = std::min(kPi * (a + 1) / h, kPi * (b + 1) / k);
  return bottom <= top ? 0.0 : std::cos(top) - std::cos(bottom);
}

double shared_columns(int a, int w, int b, int k) {
  const double left = std::max(2.0 * kPi * a / w, 2.0 * kPi * b / k);
  const double right = std::min(2.0 * kPi * (a + 1) / w, 2.0 * kPi * (b + 1) / k);
  return std::max(0.0, right - left);
}

// The mean over the preview's texel, from all texels of the picture; those that are not finite do
// not count.
double brute_mean(const test::Picture& picture, int channel, const Preview& preview, int row,
                  int column) {
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 0; i < picture.height; ++i) {
    const double rows = shared_rows(i, picture.height, row, preview.height);
    for (int j = 0; j < picture.width; ++j) {
      const bool finite = std::isfinite(picture.at(0, i, j)) &&
                          std::isfinite(picture.at(1, i, j)) && std::isfinite(picture.at(2, i, j));
      if (rows == 0.0 || !finite) continue;
      const double weight = rows * shared_columns(j, picture.width, column, preview.width);
      sum += weight * picture.at(channel, i, j);
      weights += weight;
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

void expect_brute_means(const test::Picture& picture, const Preview& preview) {
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < preview.height; ++i) {
      for (int j = 0; j < preview.width; ++j) {
        const double mean = brute_mean(picture, c, preview, i, j);
        ASSERT_NEAR(preview.planes[c][i * preview.width + j], mean, kRelativeError * mean)
            << "channel " << c << " row " << i << " column " << j;
      }
    }
  }
}

TEST(Preview, IsTheMeanOverSolidAngleForAnyRatio) {
  for (const auto& [width, height, small] :
       {std::tuple{64, 32, 16}, {64, 32, 24}, {65, 33, 17}, {40, 37, 39}, {300, 100, 7}}) {
    SCOPED_TRACE(small);
    const test::Picture picture = test::make_noisy_picture(width, height, 1);
    const Preview preview = preview_of(picture, small);
    ASSERT_EQ(preview.width, small);
    ASSERT_EQ(preview.height, (small + 1) / 2);
    expect_brute_means(picture, preview);
  }
}

// Along a row all texels are of one size: with a whole ratio the mean is the plain one.
TEST(Preview, IsThePlainMeanAlongRows) {
  const test::Picture picture =
      test::make_picture(32, 16, [](int c, int, int j) { return c + j * j; });
  const Preview preview = preview_of(picture, 8);
  for (int i = 0; i < preview.height; ++i) {
    for (int j = 0; j < 8; ++j) {
      double mean = 0.0;
      for (int k = 4 * j; k < 4 * j + 4; ++k) mean += k * k / 4.0;
      EXPECT_NEAR(preview.planes[0][i * 8 + j], mean, kRelativeError * mean);
    }
  }
}

// The integral of radiance over the sphere is the same before and after.
TEST(Preview, KeepsTheLight) {
  const test::Picture picture = test::make_noisy_picture(127, 61, 2);
  const auto total = [](int width, int height, const std::vector<float>& plane) {
    double sum = 0.0;
    for (int i = 0; i < height; ++i) {
      const double texel = shared_rows(i, height, i, height) * 2.0 * kPi / width;
      for (int j = 0; j < width; ++j) sum += texel * plane[i * width + j];
    }
    return sum;
  };
  for (const int small : {1, 2, 9, 64, 126}) {
    const Preview preview = preview_of(picture, small);
    for (int c = 0; c < 3; ++c) {
      const double light = total(127, 61, picture.planes[c]);
      EXPECT_NEAR(total(preview.width, preview.height, preview.planes[c]), light,
                  kRelativeError * light);
    }
  }
}

TEST(Preview, OfAConstantIsTheConstant) {
  const test::Picture picture =
      test::make_picture(1000, 500, [](int c, int, int) { return 0.1 + c; });
  const Preview preview = preview_of(picture, 33);
  for (int c = 0; c < 3; ++c) {
    EXPECT_THAT(preview.planes[c], testing::Each(testing::FloatNear(0.1F + c, 2e-6F * (c + 1))));
  }
}

TEST(Preview, OfItsOwnSizeIsThePicture) {
  const test::Picture picture = test::make_noisy_picture(50, 25, 3);
  for (const int width : {50, 51, 4096}) {
    const Preview preview = preview_of(picture, width);
    EXPECT_EQ(preview.width, 50);
    EXPECT_EQ(preview.height, 25);
    EXPECT_EQ(preview.planes, picture.planes);
  }
}

TEST(Preview, LeavesOutWhatIsNotFinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  test::Picture picture = test::make_noisy_picture(48, 24, 4);
  picture.at(1, 3, 5) = std::numeric_limits<float>::quiet_NaN();
  picture.at(0, 3, 6) = kInfinity;
  picture.at(2, 20, 47) = -kInfinity;
  for (const int small : {7, 12}) expect_brute_means(picture, preview_of(picture, small));
}

TEST(Preview, IsBlackWhereNothingIsFinite) {
  test::Picture picture = test::make_picture(16, 8, [](int, int, int) { return 1.0; });
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) picture.at(0, i, j) = std::numeric_limits<float>::quiet_NaN();
  }
  const Preview preview = preview_of(picture, 4);
  EXPECT_THAT(preview.planes[2], testing::ElementsAre(0.0F, testing::FloatEq(1.0F), 1.0F, 1.0F,
                                                      testing::FloatEq(1.0F), 1.0F, 1.0F, 1.0F));
}

// The largest floats neither overflow on the way nor become anything else.
TEST(Preview, BearsTheLargestFloats) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const test::Picture picture = test::make_picture(64, 32, [](int, int, int) { return kMost; });
  EXPECT_THAT(preview_of(picture, 3).planes[0],
              testing::Each(testing::FloatNear(kMost, kMost * 4e-6F)));
}

// All eight ways in which a Radiance file may run over its picture show the same picture.
TEST(Preview, IsThePictureAsItIsLookedAt) {
  constexpr int kWidth = 6;
  constexpr int kHeight = 5;
  const auto mantissa = [](int row, int column) {
    return static_cast<char>(static_cast<unsigned char>(128 + 20 * row + column));
  };
  const test::TemporaryFolder folder;
  const auto shrink = [&](bool by_rows, bool down, bool right) {
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=4\n\n";
    const std::string y = std::string(down ? "-Y " : "+Y ") + std::to_string(kHeight);
    const std::string x = std::string(right ? "+X " : "-X ") + std::to_string(kWidth);
    bytes += (by_rows ? y + " " + x : x + " " + y) + "\n";
    for (int k = 0; k < kWidth * kHeight; ++k) {
      const int i = by_rows ? k / kWidth : k % kHeight;
      const int j = by_rows ? k % kWidth : k / kHeight;
      const char m = mantissa(down ? i : kHeight - 1 - i, right ? j : kWidth - 1 - j);
      bytes += {m, m, m, static_cast<char>(static_cast<unsigned char>(136))};
    }
    std::ofstream(folder / "picture.hdr", std::ios::binary) << bytes;
    return make_preview(folder / "picture.hdr", {}, {4}, kGoOn);
  };
  const test::Picture picture = test::make_picture(kWidth, kHeight, [&](int, int i, int j) {
    return static_cast<unsigned char>(mantissa(i, j)) / 4.0;  // by its EXPOSURE
  });
  for (const bool by_rows : {true, false}) {
    for (const bool down : {true, false}) {
      for (const bool right : {true, false}) {
        const auto preview = shrink(by_rows, down, right);
        ASSERT_TRUE(preview) << preview.error().text();
        expect_brute_means(picture, *preview);
      }
    }
  }
}

TEST(Preview, ComesBackFromItsFile) {
  const test::TemporaryFolder folder;
  const Preview preview = preview_of(test::make_noisy_picture(64, 32, 5), 20);
  ASSERT_TRUE(write_preview(preview, MapFormat::exr_float, folder / "small.exr"));
  const auto again = make_preview(folder / "small.exr", {}, {20}, kGoOn);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->planes, preview.planes);
}

TEST(Preview, StopsWhenAskedTo) {
  const test::TemporaryFolder folder;
  test::write_picture(test::make_noisy_picture(64, 32, 6), MapFormat::hdr, folder / "a.hdr");
  const auto preview = make_preview(folder / "a.hdr", {}, {20}, std::atomic<bool>(true));
  ASSERT_FALSE(preview);
  EXPECT_EQ(preview.error().code, ErrorCode::interrupted);
}

// What all texels give to one texel of the smaller grid is all of it, in both samplings.
TEST(AreaShares, OfEveryTexelSumToOne) {
  for (const Sampling sampling : {Sampling::centers, Sampling::endpoints}) {
    for (const auto& [count, small] : {std::pair{2, 1}, {7, 3}, {100, 99}, {1024, 100}}) {
      for (const auto& shares :
           {column_shares(count, small, sampling), row_shares(count, small, sampling)}) {
        std::vector<double> sums(small + 1);
        for (const AreaShare& share : shares) {
          sums[share.first] += share.weight;
          sums[share.first + 1] += share.weight_behind;
        }
        // Each of the count/small + 2 weights is rounded once.
        for (int k = 0; k < small; ++k) EXPECT_NEAR(sums[k], 1.0, 1e-6);
        EXPECT_EQ(sums[small], 0.0);
      }
    }
  }
}

// Five texels on [0, 4] with both ends stand for 1/2, 1, 1, 1, 1/2 of the four cells.
TEST(AreaShares, OfBorderTexelsAreHalfACell) {
  const auto shares = column_shares(5, 2, Sampling::endpoints);
  const float expected[][2] = {
      {0.25F, 0.0F}, {0.5F, 0.0F}, {0.25F, 0.25F}, {0.5F, 0.0F}, {0.25F, 0.0F}};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(shares[i].weight, expected[i][0]) << i;
    EXPECT_EQ(shares[i].weight_behind, expected[i][1]) << i;
  }
}

}  // namespace
}  // namespace shoal
