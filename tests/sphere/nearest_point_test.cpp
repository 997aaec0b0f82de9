#include "sphere/nearest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shoal {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

TEST(NearestPoint, OfOneHalfSpaceIsItsFoot) {
  const HalfSpace beyond{{3.0, 4.0}, 10.0};  // |x| >= 2 along (3, 4)/5
  const auto x = nearest_point(2, std::span(&beyond, 1));
  ASSERT_TRUE(x.has_value());
  EXPECT_NEAR((*x)[0], 1.2, 1e-15);
  EXPECT_NEAR((*x)[1], 1.6, 1e-15);
}

TEST(NearestPoint, IsTheOriginWhereThatIsAllowed) {
  const HalfSpace around[] = {{{1.0, 0.0}, -1.0}, {{0.0, 1.0}, 0.0}};
  EXPECT_EQ(*nearest_point(2, around), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(*nearest_point(3, {}), (std::vector<double>{0.0, 0.0, 0.0}));
}

// x >= 1, y >= 1 meet in a corner; doubled and useless conditions change nothing.
TEST(NearestPoint, FindsCornersWhateverElseIsAsked) {
  const HalfSpace corner[] = {{{1.0, 0.0}, 1.0},   {{2.0, 0.0}, 2.0},  {{0.0, 1.0}, 1.0},
                              {{1.0, 1.0}, -5.0},  {{1.0, 0.0}, 0.5},  {{0.0, 0.0}, -1.0},
                              {{0.0, 1e-8}, 1e-8}, {{-1.0, 0.0}, -9.0}};
  const auto x = nearest_point(2, corner);
  ASSERT_TRUE(x.has_value());
  EXPECT_NEAR((*x)[0], 1.0, 1e-14);
  EXPECT_NEAR((*x)[1], 1.0, 1e-14);
}

TEST(NearestPoint, SaysWhereThereIsNone) {
  const HalfSpace apart[] = {{{1.0, 0.0}, 1.0}, {{-1.0, 0.0}, 1.0}};
  EXPECT_FALSE(nearest_point(2, apart).has_value());
}

// Every condition holds, and x x' >= x x for every other member x' (the nearest point of a convex
// set is the one that all others lie beyond). Members: the point all conditions were made around,
// and points between it and x, or x and random ones where they are allowed.
TEST(NearestPoint, IsNearestAmongManyConditions) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const int dimension = 1 + trial % 12;
    std::vector<double> inside(dimension);
    for (double& value : inside) value = normal(engine);
    std::vector<HalfSpace> conditions(5 + trial % 60);
    for (HalfSpace& condition : conditions) {
      for (int k = 0; k < dimension; ++k) condition.normal.push_back(normal(engine));
      condition.bound = dot(condition.normal, inside) - 0.3 * std::abs(normal(engine));
    }
    const auto x = nearest_point(dimension, conditions);
    ASSERT_TRUE(x.has_value()) << trial;
    for (const HalfSpace& condition : conditions) {
      EXPECT_GE(dot(condition.normal, *x), condition.bound - 1e-13) << trial;
    }
    EXPECT_GE(dot(*x, inside), dot(*x, *x) - 1e-13) << trial;
    for (int other = 0; other < 50; ++other) {
      std::vector<double> near = inside;
      for (double& value : near) value += 0.3 * normal(engine);
      bool allowed = true;
      for (const HalfSpace& condition : conditions) {
        allowed = allowed && dot(condition.normal, near) >= condition.bound;
      }
      if (allowed) {
        EXPECT_GE(dot(*x, near), dot(*x, *x) - 1e-13) << trial;
      }
    }
  }
}

}  // namespace
}  // namespace shoal
