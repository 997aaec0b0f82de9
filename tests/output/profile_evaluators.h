// What the consumers of profiles do with the numbers: their evaluators, from their documentation
// and sources, told beside each, and not from the profiles' data. Constants are as the consumers
// spell them.
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

// -- Programs ------------------------------------------------------------------------------------

// E = n^T M n, n = (x, y, z, 1): Ramamoorthi & Hanrahan 2001, eq. 11.
inline Evaluator ramamoorthi(const std::string& text) {
  std::vector<double> m;
  for (const std::string name :
       {"shoal_red = mat4(", "shoal_green = mat4(", "shoal_blue = mat4("}) {
    for (const double value : numbers_in(text, name, ")")) m.push_back(value);
  }
  EXPECT_EQ(m.size(), 48u);
  return [m](const Vec& d) {
    const glm::dvec4 n(d, 1.0);
    Vec sum(0.0);
    for (int c = 0; c < 3 && m.size() == 48; ++c) {
      for (int row = 0; row < 4; ++row) sum[c] += n[row] * dot4(&m[16 * c + 4 * row], n);
    }
    return sum;
  };
}

inline Evaluator seven_vectors_of_function(const std::string& text, const std::string& begin,
                                           const std::string& type) {
  // The type's own digit is none of the numbers.
  const std::size_t from = text.find(begin);
  std::string body = text.substr(from + begin.size());
  body = body.substr(0, body.find(";\n"));
  for (auto at = body.find(type); at != body.npos; at = body.find(type))
    body.erase(at, type.size());
  return seven_vectors(numbers_in("@" + body, "@"), 1.0);
}

inline Evaluator glsl(const std::string& text) {
  return seven_vectors_of_function(text, "shoal_sh[7] = vec4[7](", "vec4");
}

inline Evaluator hlsl(const std::string& text) {
  return seven_vectors_of_function(text, "shoal_sh[7] = {", "float4");
}

// src/math/SphericalHarmonics3.js: fromArray takes 27 interleaved, getIrradianceAt multiplies A_l
// Y.
inline Evaluator three(const std::string& text) {
  return weighted(numbers_in(text, "\"sh\": [", "]"), times(kCosine, kY), kPi);
}

// The explainer hands the floats to three.js.
inline Evaluator webxr(const std::string& text) {
  return weighted(numbers_in(text, "\"sphericalHarmonicsCoefficients\": [", "]"),
                  times(kCosine, kY), kPi);
}

inline std::vector<double> coefficients_array(const std::string& text) {
  return numbers_in(text, "\"coefficients\": [", "]\n  ]");
}

// sphericalPolynomial.ts: convertIncidentRadianceToIrradiance multiplies A_l,
// convertIrradianceToLambertianRadiance divides by pi, preScaleForRendering multiplies the
// constants with the Condon-Shortley sign; the shader sums bare polynomials. That is irradiance /
// pi.
inline Evaluator babylon_radiance(const std::string& text) {
  return weighted(coefficients_array(text), times(kCosine, times(kSigma, kY)), kPi);
}
inline Evaluator babylon_irradiance(const std::string& text) {
  return weighted(coefficients_array(text), times(kSigma, kY), 1 / kPi * kPi);
}
inline Evaluator babylon_lambertian(const std::string& text) {
  return weighted(coefficients_array(text), times(kSigma, kY), kPi);
}
inline Evaluator bare_coefficients(const std::string& text) {
  return weighted(coefficients_array(text), kPlain, kPi);
}

// cmgen's lines: (r, g, b); // comment
inline std::vector<double> cmgen_lines(const std::string& text) {
  std::vector<double> all;
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < 9 && std::getline(lines, line); ++i) {
    float r = 0, g = 0, b = 0;
    EXPECT_EQ(std::sscanf(line.c_str(), "(%f,%f,%f);", &r, &g, &b), 3) << line;
    all.insert(all.end(), {r, g, b});
  }
  return all;
}

// IndirectLight.h: bare polynomials, irradiance / pi.
inline Evaluator filament(const std::string& text) {
  return weighted(cmgen_lines(text), kPlain, kPi);
}
// CubemapSH.cpp: coefficients of irradiance, or of irradiance / pi before, in the signed basis.
inline Evaluator cmgen(const std::string& text) {
  return weighted(cmgen_lines(text), times(kSigma, kY), 1.0);
}
inline Evaluator cmgen_before(const std::string& text) {
  return weighted(cmgen_lines(text), times(kSigma, kY), kPi);
}

// SphericalHarmonics.cs: packs sh[c, i] into SHA = (sh3, sh1, sh2, sh0 - sh6), SHB = (sh4, sh5, 3
// sh6, sh7), SHC = sh8, and the shader gives irradiance / pi.
inline Evaluator unity(const std::string& text) {
  std::vector<double> packed(28, 1.0);
  for (int c = 0; c < 3; ++c) {
    std::array<double, 9> sh{};
    for (int i = 0; i < 9; ++i) {
      const auto value =
          numbers_in(text, "sh[" + std::to_string(c) + ", " + std::to_string(i) + "] = ", "f;");
      EXPECT_EQ(value.size(), 1u);
      if (!value.empty()) sh[i] = value[0];
    }
    const double a[] = {sh[3], sh[1], sh[2], sh[0] - sh[6]};
    const double b[] = {sh[4], sh[5], 3 * sh[6], sh[7]};
    std::copy(a, a + 4, &packed[4 * c]);
    std::copy(b, b + 4, &packed[12 + 4 * c]);
    packed[24 + c] = sh[8];
  }
  return seven_vectors(packed, kPi);
}

inline Evaluator unity_shader(const std::string& text) {
  std::vector<double> all;
  for (const std::string name : {"SHAr", "SHAg", "SHAb", "SHBr", "SHBg", "SHBb", "SHC"}) {
    for (const double value : numbers_in(text, "\"unity_" + name + "\": [", "]"))
      all.push_back(value);
  }
  return seven_vectors(all, kPi);
}

// The engine's packing of its signed, unconvolved V: C0 = 1/(2 rt pi), C1 = rt 3/(3 rt pi), C2 = rt
// 15/(8 rt pi), C3 = rt 5/(16 rt pi), C4 = C2/2.
inline Evaluator unreal(const std::string& text) {
  const double root_pi = std::sqrt(kPi);
  const double c0 = 1 / (2 * root_pi), c1 = std::sqrt(3.) / (3 * root_pi),
               c2 = std::sqrt(15.) / (8 * root_pi), c3 = std::sqrt(5.) / (16 * root_pi),
               c4 = c2 / 2;
  std::vector<double> packed(28, 1.0);
  for (int c = 0; c < 3; ++c) {
    const auto v = numbers_in(text, std::string("Shoal") + "RGB"[c] + "[12] = {", "}");
    EXPECT_EQ(v.size(), 12u);
    if (v.size() != 12) return [](const Vec&) { return Vec(0.0); };
    EXPECT_EQ(std::vector<double>(v.begin() + 9, v.end()), std::vector<double>(3, 0.0));
    const double a[] = {-c1 * v[3], -c1 * v[1], c1 * v[2], c0 * v[0] - c3 * v[6]};
    const double b[] = {c2 * v[4], -c2 * v[5], 3 * c3 * v[6], -c2 * v[7]};
    std::copy(a, a + 4, &packed[4 * c]);
    std::copy(b, b + 4, &packed[12 + 4 * c]);
    packed[24 + c] = c4 * v[8];
  }
  return seven_vectors(packed, kPi);
}

inline Evaluator unreal_float4(const std::string& text) {
  return seven_vectors(numbers_in(text, "\"vectors\": [", "]\n  ]"), kPi);
}

// lm_compute.glsl stores the mean over the sphere of 4 L Y: radiance coefficients / pi.
inline Evaluator godot(const std::string& text) {
  const auto four = numbers_in(text, "\"sh\": [", "]\n  ]");
  EXPECT_EQ(four.size(), 36u);
  std::vector<double> sh;
  for (std::size_t i = 0; i < four.size(); ++i) {
    if (i % 4 != 3) sh.push_back(four[i]);
  }
  return weighted(sh, times(kCosine, kY), kPi * kPi);
}

// ambient.js: 1, x, y, z, xz, zy, yx, 3zz-1, xx-yy, and no less than 0, which this light never is.
inline Evaluator playcanvas(const std::string& text) {
  const auto sh = numbers_in(text, "\"ambientSH\": [", "]");
  EXPECT_EQ(sh.size(), 27u);
  return [sh](const Vec& d) {
    const auto [x, y, z] = std::array{d.x, d.y, d.z};
    const double p[] = {1, x, y, z, x * z, z * y, y * x, 3 * z * z - 1, x * x - y * y};
    Vec sum(0.0);
    for (int i = 0; i < 9 && sh.size() == 27; ++i) {
      sum += kPi * p[i] * Vec(sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]);
    }
    return sum;
  };
}
inline Evaluator playcanvas_from_cubemap(const std::string& text) {
  const Evaluator exact = playcanvas(text);
  return [exact](const Vec& d) { return exact(d) / 0.98559770; };
}

// The older shader: c1..c5 of Ramamoorthi & Hanrahan, eq. 13, on L_lm.
inline Evaluator cesium_before(const std::string& text) {
  const auto v = coefficients_array(text);
  EXPECT_EQ(v.size(), 27u);
  return [v](const Vec& d) {
    const double c1 = .429043, c2 = .511664, c3 = .743125, c4 = .886227, c5 = .247708;
    const auto [x, y, z] = std::array{d.x, d.y, d.z};
    const auto sh = [&](int i) { return Vec(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
    return c1 * sh(8) * (x * x - y * y) + c3 * sh(6) * z * z + c4 * sh(0) - c5 * sh(6) +
           2 * c1 * (sh(4) * x * y + sh(7) * x * z + sh(5) * y * z) +
           2 * c2 * (sh(3) * x + sh(1) * y + sh(2) * z);
  };
}

inline std::vector<double> gltf_array(const std::string& text) {
  return numbers_in(text, "\"irradianceCoefficients\": [", "]\n          ]");
}
// Babylon's loader divides by pi and goes on as babylon_lambertian.
inline Evaluator gltf(const std::string& text) {
  return weighted(gltf_array(text), times(kSigma, kY), 1 / kPi * kPi);
}
// A reader that convolves with 1, 2/3, 1/4.
inline Evaluator gltf_unconvolved(const std::string& text) {
  return weighted(gltf_array(text), times(kCosine, times(kSigma, kY)), kPi);
}
inline Evaluator gltf_unconvolved_plain(const std::string& text) {
  return weighted(gltf_array(text), times(kCosine, kY), kPi);
}

// DirectXSH.cpp: the signed basis, planes.
inline Evaluator directxmath(const std::string& text) {
  const auto plane = [&](char c) {
    return numbers_in(text, std::string("Shoal") + c + "[9] = {", "}");
  };
  return weighted(interleaved(plane('R'), plane('G'), plane('B')),
                  times(kCosine, times(kSigma, kY)), kPi);
}

// The sample's factors.
inline Evaluator arcore(const std::string& text) {
  constexpr NineWeights kFactors = {.282095,  -.325735, .325735,  -.325735, .273137,
                                    -.273137, .078848,  -.273137, .136569};
  return weighted(numbers_in(text, "\"ambientSphericalHarmonics\": [", "]"), kFactors, kPi);
}

// spherical_harmonics.cc: the signed basis convolved with zonal coefficients c_l of the cosine
// lobe, E_lm = sqrt(4 pi / (2l + 1)) c_l L_lm.
inline Evaluator google_sh(const std::string& text) {
  const double lobe[] = {.886227, 1.02333, .495416};
  NineWeights weights = times(kSigma, kY);
  for (int i = 0; i < 9; ++i) {
    const int l = i == 0 ? 0 : i < 4 ? 1 : 2;
    weights[i] *= std::sqrt(4 * kPi / (2 * l + 1)) * lobe[l];
  }
  std::string body = text.substr(text.find("= {"));
  std::vector<double> sh;
  for (std::size_t at = body.find("Array3f("); at != body.npos; at = body.find("Array3f(")) {
    body = body.substr(at + 8);
    for (const double value : numbers_in("(" + body, "(", ")")) sh.push_back(value);
  }
  return weighted(sh, weights, 1.0);
}

// cubemapfilter.cpp: 25 in the signed basis, times 1, 2/3, 1/4, 0, -1/24 by degree.
inline Evaluator cmft(const std::string& text) {
  std::vector<double> sh;
  std::istringstream lines(text.substr(text.find("[25][3] =")));
  for (std::string line; std::getline(lines, line);) {
    if (line.find("{ ") == line.npos) continue;
    for (const double value : numbers_in(line, "{", "}")) sh.push_back(value);
  }
  return any_degree(rows_of(sh, 25), [](int l, int m) {
    return kPi * kCosineOfDegree[l] * (m % 2 == 0 ? 1.0 : -1.0);
  });
}

}  // namespace shoal::test
