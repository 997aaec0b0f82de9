// What the consumers of profiles do with the numbers: their evaluators, from their documentation
// and sources, told beside each, and not from the profiles' data. Constants are as the consumers
// spell them.
#pragma once

#include "profile_table_evaluators.h"

namespace shoal::test {

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
