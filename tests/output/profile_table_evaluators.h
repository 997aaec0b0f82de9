// Evaluators of shoal's own tables, and what those of engines are made of: sums of weighted
// polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <functional>
#include <sstream>

#include "profile_support.h"

namespace shoal::test {

using Vec = glm::dvec3;
using Evaluator = std::function<Vec(const Vec&)>;  // irradiance of a unit direction

inline constexpr double kPi = std::numbers::pi;

// Directions to degree 2: the polynomials without constants, the constants to nine digits, and the
// Condon-Shortley sign (-1)^m, in index order.
inline std::array<double, 9> polynomials(const Vec& d) {
  const auto [x, y, z] = std::array{d.x, d.y, d.z};
  return {1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y};
}
inline constexpr std::array<double, 9> kY = {.282094792, .488602512,  .488602512,
                                             .488602512, 1.092548431, 1.092548431,
                                             .315391565, 1.092548431, .546274215};
inline constexpr std::array<double, 9> kSigma = {1, -1, 1, -1, 1, -1, 1, -1, 1};
inline constexpr std::array<double, 9> kPlain = {1, 1, 1, 1, 1, 1, 1, 1, 1};
inline constexpr std::array<double, 9> kCosine = {1,       2. / 3., 2. / 3., 2. / 3., 1. / 4.,
                                                  1. / 4., 1. / 4., 1. / 4., 1. / 4.};  // A_l / pi

using NineWeights = std::array<double, 9>;

inline NineWeights times(const NineWeights& a, const NineWeights& b) {
  NineWeights product{};
  for (int i = 0; i < 9; ++i) product[i] = a[i] * b[i];
  return product;
}

// factor * sum over i of weight_i polynomial_i(d) sh_i, of 27 numbers interleaved.
inline Evaluator weighted(const std::vector<double>& sh, const NineWeights& weights,
                          double factor) {
  EXPECT_EQ(sh.size(), 27u);
  return [=](const Vec& d) {
    Vec sum(0.0);
    const auto p = polynomials(d);
    for (int i = 0; i < 9 && sh.size() == 27; ++i) {
      sum += factor * weights[i] * p[i] * Vec(sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]);
    }
    return sum;
  };
}

// Three arrays of nine.
inline std::vector<double> interleaved(const std::vector<double>& r, const std::vector<double>& g,
                                       const std::vector<double>& b) {
  std::vector<double> all;
  for (std::size_t i = 0; i < 9; ++i) {
    for (const auto* plane : {&r, &g, &b}) all.push_back(plane->size() >= 9 ? plane->at(i) : 0.0);
  }
  return all;
}

inline double dot4(const double* v, const glm::dvec4& w) {
  return v[0] * w.x + v[1] * w.y + v[2] * w.z + v[3] * w.w;
}

// Seven float4, three linear, three quadratic and a last one: dot(A, (n, 1)) + dot(B, n.xyzz
// n.yzzx) + C (x^2 - y^2), as in Unity's shaders and Unreal's.
inline Evaluator seven_vectors(const std::vector<double>& v, double factor) {
  EXPECT_EQ(v.size(), 28u);
  return [=](const Vec& n) {
    Vec sum(0.0);
    const glm::dvec4 linear(n, 1.0);
    const glm::dvec4 quadratic(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x);
    for (int c = 0; c < 3 && v.size() == 28; ++c) {
      sum[c] = factor * (dot4(&v[4 * c], linear) + dot4(&v[12 + 4 * c], quadratic) +
                         v[24 + c] * (n.x * n.x - n.y * n.y));
    }
    return sum;
  };
}

// -- Shoal's own tables --------------------------------------------------------------------------

// Y_lm of any degree through the C++ library's sph_legendre, which has the Condon-Shortley phase.
inline double library_y(int l, int m, const Vec& d) {
  const double theta = std::acos(std::clamp(d.z, -1.0, 1.0));
  const double phi = std::atan2(d.y, d.x);
  const double p = std::sph_legendre(l, std::abs(m), theta) * (m % 2 == 0 ? 1.0 : -1.0);
  if (m == 0) return p;
  return std::numbers::sqrt2 * p * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
}

inline constexpr double kCosineOfDegree[] = {1,         2. / 3., 1. / 4., 0,
                                             -1. / 24., 0,       1. / 64.};  // A_l / pi

struct Row {
  int l, m;
  Vec value;
};

inline Evaluator any_degree(const std::vector<Row>& rows,
                            const std::function<double(int, int)>& weight) {
  return [=](const Vec& d) {
    Vec sum(0.0);
    for (const Row& row : rows)
      sum += weight(row.l, row.m) * library_y(row.l, row.m, d) * row.value;
    return sum;
  };
}

inline std::vector<Row> rows_of(const std::vector<double>& numbers, int count) {
  EXPECT_EQ(numbers.size(), static_cast<std::size_t>(3 * count));
  std::vector<Row> rows;
  int i = 0;
  for (int l = 0; i < count; ++l) {
    for (int m = -l; m <= l; ++m, ++i) {
      rows.push_back({l, m, {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]}});
    }
  }
  return rows;
}

// l,m,r,g,b
inline std::vector<Row> csv_rows(const std::string& text) {
  const auto numbers = numbers_in(text, "l,m,r,g,b\n");
  std::vector<Row> rows;
  for (std::size_t i = 0; i + 5 <= numbers.size(); i += 5) {
    rows.push_back({static_cast<int>(numbers[i]),
                    static_cast<int>(numbers[i + 1]),
                    {numbers[i + 2], numbers[i + 3], numbers[i + 4]}});
  }
  EXPECT_EQ(rows.size(), 49u);
  return rows;
}

inline Evaluator plain_radiance(const std::string& text) {
  return any_degree(csv_rows(text), [](int l, int) { return kPi * kCosineOfDegree[l]; });
}

inline Evaluator plain_irradiance(const std::string& text) {
  return any_degree(csv_rows(text), [](int, int) { return 1.0; });
}

inline Evaluator plain_irradiance_over_pi(const std::string& text) {
  return any_degree(csv_rows(text), [](int, int) { return kPi; });
}

// NumPy's format 1.0: a header of 128 bytes, then floats.
inline Evaluator numpy(const std::string& bytes) {
  EXPECT_EQ(bytes.size(), 128u + 49 * 3 * sizeof(float));
  EXPECT_NE(bytes.find("'descr': '<f4', 'fortran_order': False, 'shape': (49, 3), }"), bytes.npos);
  std::vector<float> floats(49 * 3);
  std::memcpy(floats.data(), bytes.data() + 128, floats.size() * sizeof(float));
  return any_degree(rows_of({floats.begin(), floats.end()}, 49),
                    [](int l, int) { return kPi * kCosineOfDegree[l]; });
}

}  // namespace shoal::test
