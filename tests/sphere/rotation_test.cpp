#include "sphere/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "sphere/basis.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

glm::dmat3 turn(double angle, const glm::dvec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
}

const glm::dmat3 kSome = turn(1.1, {1, 2, -0.5});
const glm::dmat3 kOther = turn(-2.3, {-0.3, 0.7, 1});
const glm::dmat3 kMirror = kSome * glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1);

// The 48 signed permutations of the axes, 24 of them reflections.
std::vector<glm::dmat3> signed_permutations() {
  std::vector<glm::dmat3> all;
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (const auto& order : orders) {
    for (int signs = 0; signs < 8; ++signs) {
      glm::dmat3 matrix(0.0);
      for (int k = 0; k < 3; ++k) matrix[k][order[k]] = (signs >> k) & 1 ? -1.0 : 1.0;
      all.push_back(matrix);
    }
  }
  return all;
}

// f'(R x) = f(x), the definition.
void expect_turns_the_function(const glm::dmat3& matrix, int degree, double tolerance) {
  const Coefficients given = test::random_coefficients(degree);
  const Coefficients turned = rotate(given, matrix);
  for (const glm::dvec3& d : test::random_directions(30)) {
    const glm::dvec3 before = evaluate(given, d);
    const glm::dvec3 after = evaluate(turned, matrix * d);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c], tolerance) << "degree " << degree;
  }
}

TEST(Rotation, TurnsTheFunction) {
  for (const glm::dmat3& matrix : {kSome, kOther, kSome * kOther, kMirror}) {
    for (int degree : {0, 1, 2, 3, 5, 10}) expect_turns_the_function(matrix, degree, 1e-12);
    // 4225 random terms of size 1: |f| ~ 20, and its slope ~ 60 |f| for the rounded direction.
    expect_turns_the_function(matrix, kMaxDegree, 1e-11);
  }
}

// The function (a.x)^p turned is (R a.x)^p: a lobe about a keeps its form about R a. Its
// coefficients come from a zonal sum, Y_lm(a) times one factor a degree, here 1/(l+1).
TEST(Rotation, LobesMoveToTheirNewAxis) {
  const auto lobe = [](const glm::dvec3& axis) {
    Coefficients coefficients(20);
    std::vector<double> y(coefficient_count(20));
    Basis<double>(20).evaluate(axis, y);
    for (int l = 0; l <= 20; ++l) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        for (auto& channel : coefficients.channels) channel[i] = y[i] / (l + 1);
      }
    }
    return coefficients;
  };
  for (const glm::dvec3& axis : test::random_directions(10)) {
    for (const glm::dmat3& matrix : {kSome, kOther, kMirror}) {
      EXPECT_LT(
          test::largest_difference(rotate(lobe(axis), matrix), lobe(glm::normalize(matrix * axis))),
          5e-14);
    }
  }
}

TEST(Rotation, BlocksAreOrthogonal) {
  for (const glm::dmat3& matrix : {kSome, kMirror}) {
    const Rotation rotation(matrix, kMaxDegree);
    for (int l = 0; l <= kMaxDegree; ++l) {
      const auto block = rotation.block(l);
      const int width = 2 * l + 1;
      double worst = 0.0;
      for (int i = 0; i < width; ++i) {
        for (int j = 0; j <= i; ++j) {
          double sum = 0.0;
          for (int k = 0; k < width; ++k) sum += block[i * width + k] * block[j * width + k];
          worst = std::max(worst, std::abs(sum - (i == j ? 1.0 : 0.0)));
        }
      }
      // The matrix given is orthogonal to a few 1e-16, and degree l repeats that l times.
      EXPECT_LT(worst, 1e-15 * (l + 4)) << l;
    }
  }
}

TEST(Rotation, EveryDegreeKeepsItsPower) {
  const Coefficients given = test::random_coefficients(kMaxDegree);
  for (const glm::dmat3& matrix : {kSome, kMirror}) {
    const Coefficients turned = rotate(given, matrix);
    for (int l = 0; l <= kMaxDegree; ++l) {
      double before = 0.0, after = 0.0;
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        before += given.channels[0][i] * given.channels[0][i];
        after += turned.channels[0][i] * turned.channels[0][i];
      }
      EXPECT_NEAR(after / before, 1.0, 1e-13) << l;
    }
  }
}

TEST(Rotation, ThereAndBackAtDegree64) {
  const Coefficients given = test::random_coefficients(kMaxDegree);
  for (const glm::dmat3& matrix : {kSome, kOther, kMirror}) {
    EXPECT_LT(
        test::largest_difference(rotate(rotate(given, matrix), glm::transpose(matrix)), given),
        1e-12);
  }
}

TEST(Rotation, Composes) {
  const Coefficients given = test::random_coefficients(kMaxDegree);
  for (const glm::dmat3& second : {kOther, kMirror}) {
    EXPECT_LT(test::largest_difference(rotate(rotate(given, kSome), second),
                                       rotate(given, second * kSome)),
              1e-12);
  }
}

TEST(Rotation, IdentityLeavesTheBits) {
  Coefficients given = test::random_coefficients(12);
  given.channels[2][7] = -0.0;
  const Coefficients same = rotate(given, glm::dmat3(1.0));
  EXPECT_EQ(same, given);
  EXPECT_TRUE(std::signbit(same.channels[2][7]));
}

// f'(phi) = f(phi - alpha): cos(m (phi - alpha)) and sin(m (phi - alpha)) mix m and -m only.
TEST(Rotation, AboutThePoleIsAPhase) {
  const double alpha = 0.7;
  const Rotation rotation(turn(alpha, {0, 0, 1}), 32);
  for (int l = 0; l <= 32; ++l) {
    const auto block = rotation.block(l);
    const int width = 2 * l + 1;
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) {
        double expected = 0.0;
        if (m == n) expected = std::cos(m * alpha);
        if (m == -n && m != 0) expected = -std::sin(m * alpha);
        EXPECT_NEAR(block[(m + l) * width + n + l], expected, 2e-14) << l << ' ' << m << ' ' << n;
      }
    }
  }
}

// The point reflection is (-1)^l, the mirror z -> -z is (-1)^(l+m), y -> -y is the sign of m. The
// blocks are diagonal, their entries round to exactly +-1.
TEST(Rotation, MirrorsAreSigns) {
  const Coefficients given = test::random_coefficients(kMaxDegree);
  const Coefficients through_origin = rotate(given, glm::dmat3(-1.0));
  const Coefficients z_mirrored = rotate(given, glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1));
  const Coefficients y_mirrored = rotate(given, glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1));
  for (int l = 0; l <= kMaxDegree; ++l) {
    for (int m = -l; m <= l; ++m) {
      const int i = coefficient_index(l, m);
      const double value = given.channels[0][i];
      EXPECT_EQ(through_origin.channels[0][i], l % 2 == 0 ? value : -value);
      EXPECT_EQ(z_mirrored.channels[0][i], (l + m) % 2 == 0 ? value : -value);
      EXPECT_EQ(y_mirrored.channels[0][i], m < 0 ? -value : value);
    }
  }
}

// Each of the 48 followed by its inverse is the identity, and each turns random functions right.
TEST(Rotation, SignedPermutationsAreExact) {
  const Coefficients given = test::random_coefficients(kMaxDegree);
  for (const glm::dmat3& matrix : signed_permutations()) {
    const Coefficients turned = rotate(given, matrix);
    // Two turns, each the sum of up to 129 products with entries good to 6e-15 of random sign.
    EXPECT_LT(test::largest_difference(rotate(turned, glm::transpose(matrix)), given), 5e-14);
    expect_turns_the_function(matrix, 16, 2e-12);
  }
}

}  // namespace
}  // namespace shoal
