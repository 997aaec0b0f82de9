#include "report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <sstream>

#include "made_library.h"
#include "report/figures.h"
#include "report/page.h"
#include "report/picture.h"
#include "report/script_text.h"
#include "support/random_numbers.h"
#include "support/temporary_folder.h"

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string content_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream out;
  out << stream.rdbuf();
  return out.str();
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).string()] = content_of(entry.path());
    }
  }
  return files;
}

Status write_made(const Library& library, const fs::path& folder) {
  test::MadePictures pictures;
  return write_report(library, pictures.source(), {folder, 64, {}}, {});
}

// No byte of a name, whatever it is, can end a script or begin a tag or a comment: none of <, >, &
// is left, and the control characters that would end a string are escaped.
TEST(ScriptQuoted, HoldsNothingThatEndsAScript) {
  std::vector<std::string> names = test::hostile_names();
  for (int first = 1; first < 256; ++first) {
    names.push_back(std::string(1, static_cast<char>(first)) + "</x");
  }
  for (const std::string& name : names) {
    const std::string quoted = script_quoted(name);
    EXPECT_EQ(quoted.find_first_of("<>&\n\r"), std::string::npos) << name;
    EXPECT_EQ(quoted.find("\xE2\x80\xA8"), std::string::npos);
    EXPECT_EQ(quoted.find("\xE2\x80\xA9"), std::string::npos);
    EXPECT_EQ(quoted.front(), '"');
    EXPECT_EQ(quoted.back(), '"');
  }
  EXPECT_EQ(script_quoted("a\xFF<b"), "\"a\xEF\xBF\xBD\\u003cb\"");
}

TEST(HtmlEscaped, HoldsNoTagAndNoQuote) {
  for (const std::string& name : test::hostile_names()) {
    EXPECT_EQ(html_escaped(name).find_first_of("<>\"'"), std::string::npos) << name;
  }
  EXPECT_EQ(html_escaped("a<b>&\"'\x01\xFF"), "a&lt;b&gt;&amp;&quot;&#39;\xEF\xBF\xBD\xEF\xBF\xBD");
}

// 17 significant digits tell any two doubles apart (IEEE 754, section 5.12.2).
TEST(ExactNumber, ReadsBackAsTheSameDouble) {
  shoal::test::RandomNumbers random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random.bits());
    if (!std::isfinite(value)) continue;
    const double back = std::strtod(exact_number(value).c_str(), nullptr);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value));
  }
  EXPECT_EQ(exact_number(-0.0), "-0");
  EXPECT_EQ(exact_number(INFINITY), "null");
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

// The largest channel is 128 to 256 steps. Rounding errs by half a step, which is 1/256 of 128; but
// what lies above 255.5 becomes 255, and v - 255 <= v / 256 for v <= 256.
TEST(RgbePlanes, ErrByOne256thOfTheLargestChannel) {
  shoal::test::RandomNumbers random(2);
  Pixels pixels{64, 32, {}};
  for (int i = 0; i < 64 * 32 * 3; ++i) {
    pixels.rgb.push_back(static_cast<float>(std::exp2(random.between(-100.0, 100.0))));
  }
  pixels.rgb[0] = 255.9F;
  pixels.rgb[1] = pixels.rgb[2] = 1.0F;
  const std::string planes = rgbe_planes(pixels);
  const std::size_t count = 64 * 32;
  for (std::size_t i = 0; i < count; ++i) {
    const float* rgb = pixels.rgb.data() + 3 * i;
    const double largest = std::max({rgb[0], rgb[1], rgb[2]});
    const int exponent = static_cast<unsigned char>(planes[3 * count + i]);
    for (int c = 0; c < 3; ++c) {
      const int mantissa = static_cast<unsigned char>(planes[c * count + i]);
      EXPECT_LE(std::abs(std::ldexp(mantissa, exponent - 136) - rgb[c]), largest / 256) << i;
    }
  }
}

TEST(RgbePlanes, HaveNoPlaceForWhatIsNoLight) {
  const Pixels pixels{2, 1, {-1.0F, NAN, 1.0F, 0.0F, 0.0F, 0.0F}};
  const std::string planes = rgbe_planes(pixels);
  EXPECT_EQ(planes, std::string("\0\0\0\0\x80\0\x81\0", 8));
}

// The sum of differences is what was there, column 0 down, then along the rows.
TEST(CompressedPlanes, AreUndoneByInflatingAndAdding) {
  shoal::test::RandomNumbers random(3);
  std::string bytes;
  for (int i = 0; i < 96 * 7; ++i) bytes += static_cast<char>(random.bits());
  const std::string packed = compressed_planes(bytes, 96);
  std::string back(bytes.size(), '\0');
  auto* inflater = libdeflate_alloc_decompressor();
  ASSERT_EQ(libdeflate_zlib_decompress(inflater, packed.data(), packed.size(), back.data(),
                                       back.size(), nullptr),
            LIBDEFLATE_SUCCESS);
  libdeflate_free_decompressor(inflater);
  for (std::size_t i = 1; i < back.size(); ++i) {
    back[i] = static_cast<char>(back[i] + back[i % 96 == 0 ? i - 96 : i - 1]);
  }
  EXPECT_EQ(back, bytes);
}

TEST(Shrunk, KeepsTheMeanOfEqualAreas) {
  Pixels pixels{8, 4, {}};
  for (int i = 0; i < 8 * 4 * 3; ++i) pixels.rgb.push_back(static_cast<float>(i));
  const Pixels small = shrunk(pixels, 4);
  ASSERT_EQ(small.rgb.size(), 4u * 2 * 3);
  // Texels (0,0), (0,1), (1,0), (1,1): red 0, 3, 24, 27.
  EXPECT_EQ(small.at(0, 0)[0], 13.5F);
  EXPECT_EQ(shrunk(pixels, 16).rgb.size(), 16u * 8 * 3);
}

Panorama panorama_of(Coefficients radiance) {
  Panorama panorama;
  panorama.coefficients = std::move(radiance);
  return panorama;
}

// Constant radiance 1: irradiance is its mean everywhere, nothing dominates.
TEST(LightFigures, OfAConstantLight) {
  Coefficients radiance(4);
  for (auto& channel : radiance.channels) channel[0] = std::sqrt(4.0 * std::numbers::pi);
  const LightFigures figures = light_figures(panorama_of(radiance));
  EXPECT_NEAR(figures.mean_luminance, 1.0, 1e-15);
  EXPECT_NEAR(*figures.quality.minimum_irradiance, 1.0, 1e-14);
  EXPECT_EQ(figures.quality.negative_fraction, 0.0);
  EXPECT_NEAR(*figures.quality.contrast, 0.0, 1e-15);
  EXPECT_EQ(*figures.quality.directionality, 0.0);
  EXPECT_FALSE(figures.quality.rms_error);
  EXPECT_FALSE(figures.direction);
}

Coefficients point_of_light(const glm::dvec3& u) {
  Coefficients radiance(1);
  for (auto& channel : radiance.channels) {
    const double scale = std::sqrt(3.0 / (4.0 * std::numbers::pi));
    channel = {0.5 / std::sqrt(std::numbers::pi), scale * u.y, scale * u.z, scale * u.x};
  }
  return radiance;
}

// A point of light at u has coefficients Y_lm(u): directionality 1, direction u. To degree 1 its
// irradiance is 1/4 + cos(g)/2, of mean 1/4: least -1 of the mean, (max - min) / (max + min) = 2,
// below zero where cos g < -1/2, on a quarter of the sphere. The grid's cells are pi/64 wide, so
// the zero line, of half the sphere's circumference times sin 60, errs by less than 1 % of the
// area. Extrema are climbed to within rounding.
TEST(LightFigures, OfAPointOfLight) {
  const glm::dvec3 u(0.48, -0.6, 0.64);
  const LightFigures figures = light_figures(panorama_of(point_of_light(u)));
  EXPECT_NEAR(*figures.quality.directionality, 1.0, 1e-14);
  EXPECT_NEAR(glm::distance(*figures.direction, u), 0.0, 1e-15);
  EXPECT_NEAR(*figures.quality.minimum_irradiance, -1.0, 1e-11);
  EXPECT_NEAR(*figures.quality.contrast, 2.0, 1e-11);
  EXPECT_NEAR(figures.quality.negative_fraction, 0.25, 0.01);
}

// The store knows the light without its window and to a higher degree.
TEST(LightFigures, AreTheStoresWhereItHasThem) {
  Panorama panorama = panorama_of(point_of_light({0.0, 0.6, 0.8}));
  panorama.quality.emplace();
  panorama.quality->rms_error = 0.125;
  panorama.quality->directionality = 0.5;
  const LightFigures figures = light_figures(panorama);
  EXPECT_EQ(figures.quality.rms_error, 0.125);
  EXPECT_EQ(figures.quality.directionality, 0.5);
  EXPECT_FALSE(figures.quality.contrast);
  EXPECT_TRUE(figures.direction);
}

// sphere/conventions.h: the picture's centre is -x, a quarter turn to the right of it -y, up +z.
TEST(Directions, AreToldByThePicture) {
  EXPECT_EQ(azimuth_of({-1, 0, 0}), 0.0);
  EXPECT_EQ(azimuth_of({0, -1, 0}), 90.0);
  EXPECT_EQ(azimuth_of({0, 1, 0}), -90.0);
  EXPECT_EQ(azimuth_of({1, 0, 0}), 180.0) << "behind, not -180";
  EXPECT_EQ(elevation_of({0, 0, 1}), 90.0);
  EXPECT_EQ(elevation_of({1, 0, 0}), 0.0);
}

TEST(Page, AsksNothingOfAnyNetwork) {
  const std::string page(page_template());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("http:")));
  EXPECT_THAT(page, Not(HasSubstr("https:")));
  EXPECT_THAT(page, Not(HasSubstr("innerHTML")));
  EXPECT_THAT(page, Not(HasSubstr("eval(")));
  EXPECT_THAT(page, Not(HasSubstr("@SCRIPT")));
  // One data block, one script, and no other end of one inside them.
  std::size_t ends = 0;
  for (std::size_t at = page.find("</script"); at != std::string::npos; ++ends) {
    at = page.find("</script", at + 1);
  }
  EXPECT_EQ(ends, 2u);
}

TEST(WriteReport, GivesTheSameBytesTwice) {
  const Library library = test::made_library(5, 3);
  const shoal::test::TemporaryFolder folder;
  ASSERT_TRUE(write_made(library, folder / "a"));
  ASSERT_TRUE(write_made(library, folder / "b"));
  const auto files = files_below(folder / "a");
  EXPECT_EQ(files.size(), 1u + 2 * 5);
  EXPECT_EQ(files, files_below(folder / "b"));
}

TEST(WriteReport, RemovesWhatAnEarlierReportLeftAndNothingElse) {
  const shoal::test::TemporaryFolder folder;
  const fs::path report = folder / "report";
  ASSERT_TRUE(write_made(test::made_library(4, 2), report));
  for (const char* name : {"notes.txt", "panoramas/000099.js", "thumbnails/000098.png"}) {
    std::ofstream(report / name) << "somebody's own";
  }
  ASSERT_TRUE(write_made(test::made_library(2, 2), report));
  const auto files = files_below(report);
  EXPECT_EQ(files.size(), 1u + 2 * 2 + 3);
  EXPECT_TRUE(files.contains("panoramas/000099.js"));
  EXPECT_FALSE(files.contains("panoramas/000003.js"));
  EXPECT_FALSE(files.contains("thumbnails/000002.png"));
}

TEST(WriteReport, LeavesAnotherPageAlone) {
  const shoal::test::TemporaryFolder folder;
  std::ofstream(folder / "index.html") << "<h1>mine</h1>";
  const Status written = write_made(test::made_library(2, 2), folder.path());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::usage);
  EXPECT_EQ(content_of(folder / "index.html"), "<h1>mine</h1>");
}

TEST(WriteReport, PutsOnePanoramaIntoThePage) {
  const shoal::test::TemporaryFolder folder;
  ASSERT_TRUE(write_made(test::made_library(1, 2), folder / "report"));
  const auto files = files_below(folder / "report");
  ASSERT_EQ(files.size(), 1u);
  EXPECT_THAT(files.at("index.html"), HasSubstr("data:image/png;base64,"));
}

TEST(WriteReport, HoldsTheTablesNumbers) {
  Library library = test::made_library(2, 3);
  library.panoramas[1].coefficients.channels[2][5] = -0x1.23456789abcdep-30;
  const shoal::test::TemporaryFolder folder;
  ASSERT_TRUE(write_made(library, folder.path()));
  EXPECT_THAT(content_of(folder / "panoramas/000001.js"),
              HasSubstr("\"radiance\":\"" + exact_coefficients(library.panoramas[1].coefficients)));
}

// Texts of the store name files in full; the page leaves out where they lie.
TEST(WriteReport, TellsNoFolderOfTheMachine) {
  Library library = test::made_library(2, 2);
  for (Panorama& panorama : library.panoramas) panorama.file = "/home/some body/sky.hdr";
  library.panoramas[0].warnings = {"/home/some body/sky.hdr: 12 pixels are negative"};
  library.failed = {
      {"cut", "/home/some body/cut.hdr: ends after row 3", "/home/some body/cut.hdr"}};
  const PictureSource source = test::no_pictures("no file \"/home/some body/sky.hdr\"");
  const shoal::test::TemporaryFolder folder;
  ASSERT_TRUE(write_report(library, source, {folder.path(), 64, {}}, {}));
  for (const auto& [name, content] : files_below(folder.path())) {
    EXPECT_THAT(content, Not(HasSubstr("some body"))) << name;
  }
  EXPECT_THAT(content_of(folder / "index.html"), HasSubstr("cut.hdr: ends after row 3"));
}

// Files called alike are told apart by their paths, which begin where these differ.
TEST(WriteReport, ShortensNamesThatArePaths) {
  Library library = test::made_library(3, 2);
  library.panoramas[0].name = "/home/some body/day/sky.hdr";
  library.panoramas[1].name = "/home/some body/daylight/sky.hdr";
  library.failed = {{"/home/some body/cut.hdr", "ends after row 3"}};
  const shoal::test::TemporaryFolder folder;
  ASSERT_TRUE(write_made(library, folder.path()));
  const std::string page = content_of(folder / "index.html");
  for (const char* name : {"day/sky.hdr", "daylight/sky.hdr", "sky_0002", "cut.hdr"}) {
    EXPECT_THAT(page, HasSubstr("\"name\":\"" + std::string(name) + "\"")) << name;
  }
}

TEST(WriteReport, ListsCoefficientsThatAreNotFiniteAmongTheFailed) {
  Library library = test::made_library(3, 2);
  library.panoramas[1].coefficients.channels[0][3] = NAN;
  const shoal::test::TemporaryFolder folder;
  std::size_t told = 0;
  test::MadePictures pictures;
  ASSERT_TRUE(write_report(library, pictures.source(), {folder.path(), 64, {}},
                           [&](std::size_t done, std::size_t count) {
                             EXPECT_EQ(done, ++told);
                             EXPECT_EQ(count, 2u);
                           }));
  EXPECT_EQ(told, 2u);
  EXPECT_THAT(
      content_of(folder / "index.html"),
      HasSubstr("{\"name\":\"sky_0001\",\"error\":\"its coefficients are not all finite\"}"));
}

}  // namespace
}  // namespace shoal::viz
