// Coefficients against libsharp, the transform library of cosmology. Source: Reinecke & Seljebotn,
// "Libsharp - spherical harmonic transforms revisited", Astronomy & Astrophysics 554 (2013), A112.
//
// Shared with shoal are only the decoded pixels. Rings, their weights, the Legendre recurrence and
// the Fourier transform are libsharp's, but for the two rules that it does not have:
//   midpoint  one ring a row of weight sin(theta_i) dtheta dphi;
//   texel     the row's integral as five Gauss-Legendre rings that all show the row's pixels, and
//             order m times the mean of cos(m phi) over a pixel, sin(m dphi/2) / (m dphi/2).
// libsharp analyses into complex harmonics with the Condon-Shortley phase,
//   Y_lm = (-1)^m Pbar_lm(cos theta) / sqrt 2 * exp(i m phi)   for m > 0,
// and a_lm is the integral of I conj(Y_lm); so with Pbar and the real basis of
// sphere/conventions.h, L_lm = (-1)^m sqrt 2 Re a_lm and L_l(-m) = -(-1)^m sqrt 2 Im a_lm.
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <libsharp/sharp.h>
#include <libsharp/sharp_almhelpers.h>
#include <libsharp/sharp_geomhelpers.h>

#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "image/exr_file.h"
#include "image/panorama_pixels.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"
#include "transform/projector.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

struct DestroyGeometry {
  void operator()(sharp_geom_info* geometry) const { sharp_destroy_geom_info(geometry); }
};
struct DestroyHarmonics {
  void operator()(sharp_alm_info* harmonics) const { sharp_destroy_alm_info(harmonics); }
};
using Geometry = std::unique_ptr<sharp_geom_info, DestroyGeometry>;
using Harmonics = std::unique_ptr<sharp_alm_info, DestroyHarmonics>;

// Rings that show rows of a picture with pixel centres; several may show the same row.
class Rings {
 public:
  explicit Rings(int width) : width_(width) {}

  // `weight` is the ring's share of the integral over theta, sin(theta) included.
  void add(int row, double theta, double weight) {
    offsets_.push_back(static_cast<std::ptrdiff_t>(row) * width_);
    thetas_.push_back(theta);
    weights_.push_back(weight * 2.0 * kPi / width_);
  }

  [[nodiscard]] Geometry geometry() const {
    const std::size_t count = thetas_.size();
    const std::vector<int> widths(count, width_);
    const std::vector<int> strides(count, 1);
    const std::vector<double> first_phis(count, kPi / width_);
    sharp_geom_info* geometry = nullptr;
    sharp_make_geom_info(static_cast<int>(count), widths.data(), offsets_.data(), strides.data(),
                         first_phis.data(), thetas_.data(), weights_.data(), &geometry);
    return Geometry(geometry);
  }

 private:
  int width_;
  std::vector<std::ptrdiff_t> offsets_;
  std::vector<double> thetas_;
  std::vector<double> weights_;
};

Geometry midpoint_geometry(int width, int height) {
  Rings rings(width);
  for (int row = 0; row < height; ++row) {
    const double theta = kPi * (row + 0.5) / height;
    rings.add(row, theta, std::sin(theta) * kPi / height);
  }
  return rings.geometry();
}

// The five-point rule's error on a row of height h is at most h^11 f^(10) / 2.5e12. With f of
// degree l + 1, sin(theta) included, that is ((l + 1) h)^10 / 2.5e12 relative: 1e-13 for 32 rows to
// degree 8 or 128 to degree 32.
Geometry texel_geometry(int width, int height) {
  const double inner = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double outer = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double inner_weight = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0;
  const double outer_weight = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
  const std::array nodes = {-outer, -inner, 0.0, inner, outer};
  const std::array weights = {outer_weight, inner_weight, 128.0 / 225.0, inner_weight,
                              outer_weight};
  Rings rings(width);
  for (int row = 0; row < height; ++row) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double theta = kPi * (row + 0.5 + 0.5 * nodes[k]) / height;
      rings.add(row, theta, 0.5 * weights[k] * std::sin(theta) * kPi / height);
    }
  }
  return rings.geometry();
}

Geometry geometry_of(const EquirectGrid& grid, Quadrature quadrature) {
  sharp_geom_info* geometry = nullptr;
  switch (quadrature) {
    case Quadrature::texel:
      return texel_geometry(grid.width, grid.height);
    case Quadrature::midpoint:
      return midpoint_geometry(grid.width, grid.height);
    case Quadrature::fejer:
      sharp_make_fejer1_geom_info(grid.height, grid.width, kPi / grid.width, 1, grid.width,
                                  &geometry);
      return Geometry(geometry);
    default:
      // The last column is the first one's meridian again: a ring ends before it.
      sharp_make_cc_geom_info(grid.height, grid.width - 1, 0.0, 1, grid.width, &geometry);
      return Geometry(geometry);
  }
}

// The real coefficients of one channel; `map` is (height, width).
std::vector<double> analyse(std::vector<double> map, const sharp_geom_info& geometry, int degree) {
  sharp_alm_info* made = nullptr;
  sharp_make_triangular_alm_info(degree, degree, 1, &made);
  const Harmonics harmonics(made);
  std::vector<std::complex<double>> complex_values(sharp_alm_count(made));
  void* map_data = map.data();
  void* complex_data = complex_values.data();
  sharp_execute(SHARP_MAP2ALM, 0, &complex_data, &map_data, &geometry, made, SHARP_DP, nullptr,
                nullptr);
  std::vector<double> real(coefficient_count(degree));
  for (int l = 0; l <= degree; ++l) {
    real[coefficient_index(l, 0)] = complex_values[sharp_alm_index(made, l, 0)].real();
    for (int m = 1; m <= l; ++m) {
      const std::complex<double> a = complex_values[sharp_alm_index(made, l, m)];
      const double gain = (m % 2 == 0 ? 1.0 : -1.0) * std::numbers::sqrt2;
      real[coefficient_index(l, m)] = gain * a.real();
      real[coefficient_index(l, -m)] = -gain * a.imag();
    }
  }
  return real;
}

// The mean of cos(m phi) over a pixel, by which the texel rule's order m differs.
void average_over_pixels(std::vector<double>& coefficients, int degree, int width) {
  for (int l = 0; l <= degree; ++l) {
    for (int m = 1; m <= l; ++m) {
      const double half = m * kPi / width;
      coefficients[coefficient_index(l, m)] *= std::sin(half) / half;
      coefficients[coefficient_index(l, -m)] *= std::sin(half) / half;
    }
  }
}

std::vector<double> channel_of(const test::PanoramaPixels& pixels, int channel) {
  std::vector<double> map(static_cast<std::size_t>(pixels.width) * pixels.height);
  for (std::size_t i = 0; i < map.size(); ++i) {
    map[i] = pixels.values[i * pixels.channel_count + channel];
  }
  return map;
}

// Seam pixels stand twice in the picture; half of each is the meridian's light.
void join_seam(std::vector<double>& map, const EquirectGrid& grid) {
  for (int row = 0; row < grid.height; ++row) {
    double* first = map.data() + static_cast<std::ptrdiff_t>(row) * grid.width;
    *first = 0.5 * (*first + first[grid.width - 1]);
  }
}

// Pixels by shoal's reader, everything after that by libsharp.
Coefficients libsharp_coefficients(const test::PanoramaPixels& pixels, const EquirectGrid& grid,
                                   Quadrature quadrature, int degree) {
  const Geometry geometry = geometry_of(grid, quadrature);
  Coefficients coefficients(degree);
  for (int c = 0; c < kChannelCount; ++c) {
    std::vector<double> map = channel_of(pixels, c);
    if (quadrature == Quadrature::clenshaw_curtis) join_seam(map, grid);
    coefficients.channels[c] = analyse(std::move(map), *geometry, degree);
    if (quadrature == Quadrature::texel) {
      average_over_pixels(coefficients.channels[c], degree, grid.width);
    }
  }
  return coefficients;
}

// The kernels compute in single precision, relative to the light there is; the twin does not.
double tolerance_of(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::kernels ? 1e-6 : 1e-12;
}

void expect_agreement(const std::filesystem::path& path, const test::PanoramaPixels& pixels,
                      const ProjectionSettings& settings) {
  ProjectionTables tables;
  const auto mine = project_panorama(path, {}, settings, tables);
  ASSERT_TRUE(mine) << mine.error().text();
  const Coefficients peer =
      libsharp_coefficients(pixels, mine->grid, mine->quadrature, settings.degree);
  for (int c = 0; c < kChannelCount; ++c) {
    const double bound = tolerance_of(settings.arithmetic) * peer.channels[c][0];
    ASSERT_GT(bound, 0.0);
    for (int i = 0; i < coefficient_count(settings.degree); ++i) {
      EXPECT_NEAR(mine->radiance.channels[c][i], peer.channels[c][i], bound)
          << path << " " << name_of(mine->quadrature) << " channel " << c << " index " << i;
    }
  }
}

void expect_agreement(const std::filesystem::path& path, int degree,
                      const std::vector<Quadrature>& quadratures, Arithmetic arithmetic) {
  const auto source = open_panorama(path, {}, portable_chunk_codecs());
  ASSERT_TRUE(source) << source.error().text();
  ASSERT_EQ((*source)->info().to_linear_rec709, glm::dmat3(1.0)) << "a file without colour matrix";
  const auto pixels = test::read_all(**source);
  ASSERT_TRUE(pixels) << pixels.error().text();
  ASSERT_EQ(pixels->channel_count, kChannelCount);
  for (const Quadrature quadrature : quadratures) {
    ProjectionSettings settings;
    settings.degree = degree;
    settings.quadrature = quadrature;
    settings.arithmetic = arithmetic;
    expect_agreement(path, *pixels, settings);
  }
}

const std::vector<Quadrature> kCenterRules = {Quadrature::texel, Quadrature::midpoint,
                                              Quadrature::fejer};

// What the conversion to the real basis rests on, apart from shoal: the polynomials of degree 1 and
// 2 have their own coefficient alone, of size 1. Fejer's rule is exact on them.
TEST(Libsharp, AnalysisFindsTheRealBasis) {
  const EquirectGrid grid{16, 8, Sampling::centers};
  const Geometry geometry = geometry_of(grid, Quadrature::fejer);
  for (int index = 0; index < 9; ++index) {
    std::vector<double> map;
    for (int i = 0; i < grid.height; ++i) {
      for (int j = 0; j < grid.width; ++j) {
        const double theta = kPi * (i + 0.5) / grid.height;
        const double phi = 2.0 * kPi * (j + 0.5) / grid.width;
        const double x = std::sin(theta) * std::cos(phi);
        const double y = std::sin(theta) * std::sin(phi);
        const double z = std::cos(theta);
        const double a = std::sqrt(0.75 / kPi);
        const double b = std::sqrt(3.75 / kPi);
        const std::array basis = {std::sqrt(0.25 / kPi),
                                  a * y,
                                  a * z,
                                  a * x,
                                  b * x * y,
                                  b * y * z,
                                  b * (3.0 * z * z - 1.0) / std::sqrt(12.0),
                                  b * x * z,
                                  b * (x * x - y * y) / 2.0};
        map.push_back(basis[index]);
      }
    }
    const std::vector<double> coefficients = analyse(map, *geometry, 2);
    for (int i = 0; i < 9; ++i) {
      EXPECT_NEAR(coefficients[i], i == index ? 1.0 : 0.0, 1e-14) << "Y " << index << " at " << i;
    }
  }
}

// Even and odd heights, and a picture so narrow that its orders alias; a sun of 10^5 in each.
TEST(Libsharp, AgreesOnMadePictures) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{64, 32}, {67, 33}, {13, 48}}) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    const auto path = folder / "made.exr";
    test::write_picture(test::make_noisy_picture(width, height, width), MapFormat::exr_float, path);
    expect_agreement(path, 8, kCenterRules, Arithmetic::kernels);
    expect_agreement(path, 8, kCenterRules, Arithmetic::reference);
  }
}

TEST(Libsharp, AgreesOnAMadePictureToDegree32) {
  const test::TemporaryFolder folder;
  const auto path = folder / "made.exr";
  test::write_picture(test::make_noisy_picture(256, 128, 1), MapFormat::exr_float, path);
  expect_agreement(path, 32, kCenterRules, Arithmetic::kernels);
  expect_agreement(path, 32, kCenterRules, Arithmetic::reference);
}

// Border pixels on the poles and on the seam, whose two columns differ here; even and odd heights.
TEST(Libsharp, AgreesOnMadeEnvironmentMaps) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{65, 33}, {40, 24}}) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    test::ExrRecipe recipe;
    recipe.data = recipe.display = {{0, 0}, {width - 1, height - 1}};
    recipe.types.assign(3, SampleType::float32);
    Imf::Header header = test::make_header(recipe);
    Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
    const auto path = folder / "made.exr";
    test::write_exr(path, recipe, test::make_raw(width, height, recipe.types, 1), &header);
    expect_agreement(path, 8, {Quadrature::clenshaw_curtis}, Arithmetic::kernels);
    expect_agreement(path, 8, {Quadrature::clenshaw_curtis}, Arithmetic::reference);
  }
}

TEST(Libsharp, AgreesOnRealRadianceFiles) {
  SHOAL_REQUIRE_TEST_DATA("pmndrs_hdr");
  for (const char* name : {"apartment", "city", "sky", "studio", "sunset", "venice"}) {
    const auto path = test::data_folder() / "pmndrs_hdr" / (std::string(name) + ".hdr");
    expect_agreement(path, 8, kCenterRules, Arithmetic::kernels);
  }
}

TEST(Libsharp, AgreesOnRealExrFiles) {
  SHOAL_REQUIRE_TEST_DATA("blender_exr");
  for (const char* name : {"courtyard", "interior", "night", "studio"}) {
    const auto path = test::data_folder() / "blender_exr" / (std::string(name) + ".exr");
    expect_agreement(path, 8, kCenterRules, Arithmetic::kernels);
  }
}

TEST(Libsharp, AgreesOnARealPanoramaToDegree32) {
  SHOAL_REQUIRE_TEST_DATA("pmndrs_hdr");
  expect_agreement(test::data_folder() / "pmndrs_hdr/venice.hdr", 32, kCenterRules,
                   Arithmetic::kernels);
}

TEST(Libsharp, AgreesOnARealEnvironmentMap) {
  const std::string name = "openexr-images/MultiResolution/OrientationLatLong.exr";
  SHOAL_REQUIRE_TEST_DATA(name);
  expect_agreement(test::data_folder() / name, 8, {Quadrature::clenshaw_curtis},
                   Arithmetic::kernels);
}

}  // namespace
}  // namespace shoal
