#include "sphere/turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sphere/quadrature.h"
#include "sphere/rotation.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kCentre(-1, 0, 0), kRight(0, -1, 0), kUp(0, 0, 1);

// The direction that an equirect picture shows at a column's and a row's fraction.
glm::dvec3 shown_at(double across, double down) {
  const double phi = 2 * kPi * across, theta = kPi * down;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double tolerance = 1e-15) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], tolerance);
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += glm::dot(a[k] - b[k], a[k] - b[k]);
  return std::sqrt(sum);
}

TEST(PictureTurn, YawMovesThePictureToTheRight) {
  const glm::dmat3 turn = *turn_matrix({.yaw = 36.0});
  for (double across : {0.0, 0.25, 0.5, 0.8}) {
    for (double down : {0.1, 0.5, 0.7}) {
      expect_near(turn * shown_at(across, down), shown_at(across + 0.1, down));
    }
  }
}

TEST(PictureTurn, PitchMovesTheCentreUp) {
  expect_near(*turn_matrix({.pitch = 36.0}) * kCentre, shown_at(0.5, 0.3));
  expect_near(*turn_matrix({.pitch = 36.0}) * kRight, kRight);
}

// Clockwise: up goes to the right, right goes down.
TEST(PictureTurn, RollTurnsClockwise) {
  const glm::dmat3 turn = *turn_matrix({.roll = 90.0});
  EXPECT_EQ(turn * kUp, kRight);
  EXPECT_EQ(turn * kRight, -kUp);
  EXPECT_EQ(turn * kCentre, kCentre);
}

TEST(PictureTurn, RollThenPitchThenYaw) {
  const glm::dmat3 all = *turn_matrix({.yaw = 20, .pitch = 30, .roll = 40});
  const glm::dmat3 stepwise =
      *turn_matrix({.yaw = 20}) * *turn_matrix({.pitch = 30}) * *turn_matrix({.roll = 40});
  EXPECT_LT(distance(all, stepwise), 1e-15);
  // A sun at the centre, which roll leaves there, gets elevation 30 and then goes 20 to the right.
  expect_near(all * kCentre, shown_at(0.5 + 20.0 / 360, (90.0 - 30.0) / 180));
}

// Quarter turns, also far beyond a full one, are exact; two make a half turn.
TEST(PictureTurn, QuarterTurnsAreSignedPermutations) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    for (int which = 0; which < 3; ++which) {
      PictureTurn turn;
      (which == 0 ? turn.yaw : which == 1 ? turn.pitch : turn.roll) = 90.0 * quarter;
      const glm::dmat3 matrix = *turn_matrix(turn);
      for (int column = 0; column < 3; ++column) {
        double length = 0.0;
        for (int row = 0; row < 3; ++row) {
          const double value = matrix[column][row];
          EXPECT_TRUE(value == 0.0 || value == 1.0 || value == -1.0) << value;
          length += std::abs(value);
        }
        EXPECT_EQ(length, 1.0);
      }
      if (quarter % 4 == 0) {
        EXPECT_EQ(matrix, glm::dmat3(1.0));
      }
    }
  }
  EXPECT_EQ(*turn_matrix({.yaw = 90}) * kCentre, kRight);
  EXPECT_EQ(*turn_matrix({.yaw = -90}) * kCentre, -kRight);
  EXPECT_EQ(*turn_matrix({.pitch = 90}) * kCentre, kUp);
  EXPECT_EQ(*turn_matrix({.yaw = 180}) * kCentre, -kCentre);
}

// Yaw is the phase f'(phi) = f(phi - alpha) on the orders m and -m, at every degree to 64.
TEST(PictureTurn, YawIsAPhase) {
  const double alpha = 25.0;
  const Coefficients given = test::random_coefficients(kMaxDegree);
  const Coefficients turned = rotate(given, *turn_matrix({.yaw = alpha}));
  for (int l = 0; l <= kMaxDegree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const double c = std::cos(m * alpha * kPi / 180), s = std::sin(m * alpha * kPi / 180);
      const double even = given.channels[0][coefficient_index(l, m)];
      const double odd = m == 0 ? 0.0 : given.channels[0][coefficient_index(l, -m)];
      // 1e-14 an entry of the block, 129 of them in an order.
      EXPECT_NEAR(turned.channels[0][coefficient_index(l, m)], even * c - odd * s, 1e-12);
      if (m > 0) {
        EXPECT_NEAR(turned.channels[0][coefficient_index(l, -m)], even * s + odd * c, 1e-12);
      }
    }
  }
}

TEST(PictureTurn, ThereAndBackAtDegree64) {
  const Coefficients given = test::random_coefficients(kMaxDegree);
  const glm::dmat3 there = *turn_matrix({.yaw = 20, .pitch = -35, .roll = 170});
  const Coefficients turned = rotate(given, there);
  EXPECT_LT(test::largest_difference(rotate(turned, glm::transpose(there)), given), 1e-12);
  // The way back in the picture's own terms.
  const glm::dmat3 back =
      *turn_matrix({.roll = -170}) * *turn_matrix({.pitch = 35}) * *turn_matrix({.yaw = -20});
  EXPECT_LT(test::largest_difference(rotate(turned, back), given), 1e-12);
}

// A picture whose columns move right by whole ones is the panorama turned by their angle: the texel
// quadrature knows every column alike. Both sides sum the same 32 x 16 products in another order.
TEST(PictureTurn, YawByWholeColumnsIsTheShiftedPicture) {
  constexpr int kWidth = 32, kHeight = 16, kDegree = 8;
  const ProjectionWeights weights =
      make_projection_weights({kWidth, kHeight, Sampling::centers}, Quadrature::texel, kDegree);
  const auto pixel = [](int row, int column) {
    return 1.0 + std::sin(3.1 * row * row + 1.7 * column * column * (row + 2));
  };
  const auto project = [&](int shift) {
    Coefficients sum(kDegree);
    for (int l = 0; l <= kDegree; ++l) {
      for (int m = -l; m <= l; ++m) {
        const int k = std::abs(m);
        double total = 0.0;
        for (int i = 0; i < kHeight; ++i) {
          double moment = 0.0;
          for (int j = 0; j < kWidth; ++j) {
            const double angle = k * 2 * kPi * (j + 0.5) / kWidth;
            moment += pixel(i, (j - shift + kWidth) % kWidth) *
                      (m >= 0 ? std::cos(angle) : std::sin(angle));
          }
          const bool south = i >= kHeight / 2;
          const double polar = weights.polar_row_weights(l, k)[south ? kHeight - 1 - i : i];
          total += (south && (l + k) % 2 == 1 ? -polar : polar) * moment;
        }
        for (auto& channel : sum.channels) {
          channel[coefficient_index(l, m)] = weights.azimuth[k] * total;
        }
      }
    }
    return sum;
  };
  const Coefficients still = project(0);
  for (int shift : {1, 5, 8, 31}) {
    const glm::dmat3 turn = *turn_matrix({.yaw = 360.0 * shift / kWidth});
    EXPECT_LT(test::largest_difference(rotate(still, turn), project(shift)), 1e-13) << shift;
  }
}

// In a frame's own coordinates, x' = R x by the right-hand formula: about +y, z goes to x; whether
// the frame, taken as right-handed, mirrors the picture or not.
TEST(AxisTurn, IsTheRightHandFormulaInTheFrame) {
  for (const char* name : {"native", "openexr", "cmft", "three", "materialx", "+y,-z,-x"}) {
    const Frame frame = *parse_frame(name);
    const glm::dmat3 to = native_to_frame(frame);
    const glm::dmat3 turn = *axis_turn({0, 7, 0}, 90.0, frame);
    EXPECT_EQ(to * turn * glm::transpose(to) * glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)) << name;
    EXPECT_EQ(to * turn * glm::transpose(to) * glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)) << name;

    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -3));
    const glm::dmat3 slanted = to * *axis_turn(1e-200 * axis, 50.0, frame) * glm::transpose(to);
    const double c = std::cos(50 * kPi / 180), s = std::sin(50 * kPi / 180);
    for (const glm::dvec3& x : test::random_directions(10)) {
      expect_near(slanted * x,
                  c * x + s * glm::cross(axis, x) + (1 - c) * glm::dot(axis, x) * axis);
    }
  }
}

// The picture's yaw is a turn about up, by the angle's sign that the frame's handedness asks for.
TEST(AxisTurn, AboutUpIsYaw) {
  const glm::dmat3 yaw = *turn_matrix({.yaw = 33});
  EXPECT_LT(distance(*axis_turn({0, 0, 1}, 33, Frame{}), yaw), 1e-15);
  EXPECT_LT(distance(*axis_turn({0, 1, 0}, 33, *parse_frame("cmft")), yaw), 1e-15);
  EXPECT_LT(distance(*axis_turn({0, 1, 0}, -33, *parse_frame("openexr")), yaw), 1e-15);
}

TEST(QuaternionTurn, IsTheAxisTurnOfItsHalfAngle) {
  const Frame frame = *parse_frame("openexr");
  for (const glm::dvec3& axis : test::random_directions(10)) {
    for (double angle : {10.0, 123.0, -77.0, 180.0}) {
      const double half = angle * kPi / 360;
      for (double length : {1.0, -3.0, 1e-180, 1e180}) {
        const glm::dquat q(length * std::cos(half), length * std::sin(half) * axis);
        EXPECT_LT(distance(*quaternion_turn(q, frame), *axis_turn(axis, angle, frame)), 2e-15);
      }
    }
  }
  EXPECT_EQ(*quaternion_turn(glm::dquat(2, 0, 0, 0), frame), glm::dmat3(1.0));
}

TEST(Turns, RefuseWhatMakesNoSense) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Frame frame;
  for (const auto& bad :
       {turn_matrix({.yaw = std::nan("")}), turn_matrix({.pitch = infinity}),
        turn_matrix({.roll = -infinity}), axis_turn({0, 0, 0}, 1, frame),
        axis_turn({0, infinity, 0}, 1, frame), axis_turn({0, 1, 0}, std::nan(""), frame),
        quaternion_turn(glm::dquat(0, 0, 0, 0), frame),
        quaternion_turn(glm::dquat(1, 0, std::nan(""), 0), frame)}) {
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().code, ErrorCode::usage);
  }
}

TEST(SpreadTurns, AreEvenYaws) {
  const auto turns = spread_turns(8);
  ASSERT_EQ(turns.size(), 8u);
  EXPECT_EQ(turns[0], glm::dmat3(1.0));
  EXPECT_EQ(turns[2], *turn_matrix({.yaw = 90}));
  for (int k = 0; k < 8; ++k) EXPECT_EQ(turns[k], *turn_matrix({.yaw = 45.0 * k}));
  EXPECT_EQ(spread_turns(1).front(), glm::dmat3(1.0));
}

// By Schur's orthogonality the mean over all rotations of the matrix that turns degree l >= 1 is
// zero. Over N rotations drawn at random the mean's square norm is (2l+1)/N on average; an even set
// comes much nearer to zero, and ever nearer as N grows.
TEST(SpreadAll, MeansOfTheBlocksVanish) {
  const auto mean_norm = [](int count, int l) {
    std::vector<double> sum((2 * l + 1) * (2 * l + 1), 0.0);
    for (const glm::dmat3& rotation : spread_all(count)) {
      const Rotation turn(rotation, l);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += turn.block(l)[k] / count;
    }
    double square = 0.0;
    for (double value : sum) square += value * value;
    return std::sqrt(square);
  };
  for (int l = 1; l <= 4; ++l) {
    const double few = mean_norm(100, l), many = mean_norm(3000, l);
    RecordProperty("few" + std::to_string(l), std::to_string(few));
    RecordProperty("many" + std::to_string(l), std::to_string(many));
    EXPECT_LT(few, 0.5 * std::sqrt((2 * l + 1) / 100.0)) << l;
    EXPECT_LT(many, 0.1 * std::sqrt((2 * l + 1) / 3000.0)) << l;
  }
}

TEST(SpreadAll, AreRotationsTheFirstOfWhichIsNone) {
  for (int count : {1, 2, 7, 500}) {
    const auto rotations = spread_all(count);
    ASSERT_EQ(static_cast<int>(rotations.size()), count);
    EXPECT_EQ(rotations.front(), glm::dmat3(1.0));
    for (const glm::dmat3& rotation : rotations) {
      EXPECT_LT(distance(glm::transpose(rotation) * rotation, glm::dmat3(1.0)), 1e-15);
      EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-15);
    }
    EXPECT_EQ(rotations, spread_all(count));
  }
}

}  // namespace
}  // namespace shoal
