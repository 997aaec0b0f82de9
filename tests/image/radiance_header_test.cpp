// What a Radiance header says about its picture, and what is done about headers that say nonsense.
#include "image/radiance_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "image/radiance_file.h"
#include "image/radiance_source.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RadianceHeaders : public ::testing::Test {
 protected:
  Result<RadianceHeader> parse(const std::string& bytes) {
    test::write_bytes(file_, bytes);
    auto file = InputFile::open(file_);
    if (!file) return file.error();
    return read_radiance_header(*file);
  }

  // A header with `lines` in it, in front of one flat pixel.
  Result<RadianceHeader> with_lines(const std::string& lines) {
    return parse(test::radiance_header("-Y 1 +X 1", lines) + "\x80\x80\x80\x80");
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "picture.hdr";
};

TEST_F(RadianceHeaders, ExposuresMultiplyAndAreDividedOut) {
  const auto header = with_lines("EXPOSURE=2\nVIEW= -vtv\nEXPOSURE= 4.0e+00 \n");
  ASSERT_TRUE(header) << header.error().text();
  EXPECT_EQ(header->to_linear_rec709, glm::dmat3(0.125));
  EXPECT_THAT(header->warnings, IsEmpty());
}

TEST_F(RadianceHeaders, ColourCorrectionsMultiplyByChannel) {
  const auto header = with_lines("COLORCORR=2 4 8\nEXPOSURE=2\nCOLORCORR= 0.5 1 +1.0\n");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->to_linear_rec709, glm::dmat3(0.5, 0, 0, 0, 0.125, 0, 0, 0, 0.0625));
  EXPECT_THAT(header->warnings, IsEmpty());
}

// One that cannot be divided by says nothing about the picture, and others still count.
TEST_F(RadianceHeaders, ExposuresThatAreNoneAreIgnoredWithAWarning) {
  for (const std::string nonsense : {"0", "-1", "nan", "inf", "-inf", "", " ", "bright", "1,5",
                                     "2 3", "0x10", "1e-320", "1e400"}) {
    const auto header = with_lines("EXPOSURE=2\nEXPOSURE=" + nonsense + "\n");
    ASSERT_TRUE(header) << nonsense;
    EXPECT_EQ(header->to_linear_rec709, glm::dmat3(0.5)) << nonsense;
    ASSERT_EQ(header->warnings.size(), 1u) << nonsense;
    EXPECT_THAT(header->warnings[0], HasSubstr("EXPOSURE"));
    const auto corrected = with_lines("COLORCORR=1 1 " + nonsense + "\n");
    EXPECT_EQ(corrected->to_linear_rec709, glm::dmat3(1.0));
    EXPECT_EQ(corrected->warnings.size(), 1u) << nonsense;
  }
  // Each factor is fine, but not their product: 1e-200 * 1e-200 underflows.
  for (const std::string second : {"EXPOSURE=1e-200\n", "COLORCORR=1 1e-200 1\n"}) {
    const auto header = with_lines("EXPOSURE=1e-200\n" + second);
    EXPECT_DOUBLE_EQ(header->to_linear_rec709[0][0], 1e200);
    EXPECT_EQ(header->warnings.size(), 1u);
  }
}

TEST_F(RadianceHeaders, HistoryOfOtherFilesIsNotThisOnes) {
  const auto header = with_lines("pcomb\n\tEXPOSURE=8\n\tFORMAT=32-bit_rle_xyze\n#EXPOSURE=3\n");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->to_linear_rec709, glm::dmat3(1.0));
  EXPECT_EQ(header->colour, RadianceColour::rgbe);
  EXPECT_THAT(header->warnings, IsEmpty());
}

TEST_F(RadianceHeaders, PrimariesOtherThanRec709AreWorthAWarning) {
  for (const std::string fine :
       {"0 0 0 0 0 0 0 0", "0.640 0.330 0.300 0.600 0.150 0.060 0.313 0.329"}) {
    EXPECT_THAT(with_lines("GAMMA=1\nPRIMARIES=" + fine + "\n")->warnings, IsEmpty()) << fine;
  }
  for (const std::string other :
       {"0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333", "0.7 0.3 0.2", "red green blue"}) {
    EXPECT_THAT(with_lines("PRIMARIES=" + other + "\n")->warnings,
                ElementsAre(HasSubstr("taken as Rec.709")))
        << other;
  }
}

TEST_F(RadianceHeaders, Formats) {
  const std::string end = "\n-Y 1 +X 1\n\x80\x80\x80\x80";
  EXPECT_THAT(parse("#?RGBE\n" + end)->warnings, ElementsAre(HasSubstr("no FORMAT")));
  EXPECT_THAT(parse("#?RGBE\nFORMAT= 32-bit_rle_rgbe \r\n" + end)->warnings, IsEmpty());
  EXPECT_THAT(parse("\nFORMAT=32-bit_rle_rgbe\n" + end)->warnings, IsEmpty()) << "before 1991";
  EXPECT_EQ(parse("#?RADIANCE\nFORMAT=ascii\n" + end).error().code, ErrorCode::unsupported);
  EXPECT_EQ(parse("RADIANCE\n" + end).error().code, ErrorCode::malformed);
}

// The matrix against its definition: the primaries r, g, b of Rec.709 as XYZ, scaled so that they
// sum to white, are taken to the unit vectors. Chromaticities are (x, y), XYZ = (x/y, 1,
// (1-x-y)/y).
TEST_F(RadianceHeaders, XyzeMatrixFollowsFromThePrimaries) {
  const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1.0, (1.0 - x - y) / y); };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const glm::dvec3 scale = glm::inverse(primaries) * xyz(0.3127, 0.3290);
  for (int c = 0; c < 3; ++c) {
    const glm::dvec3 rgb = xyz_to_rec709() * (primaries[c] * scale[c]);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(rgb[k], c == k ? 1.0 : 0.0, 1e-14);
  }
  // In a file, EXPOSURE and COLORCORR are undone first: they were applied to X, Y and Z.
  const auto header =
      parse(test::radiance_header("-Y 1 +X 1", "EXPOSURE=2\nCOLORCORR=1 2 4\n", "32-bit_rle_xyze") +
            "\x80\x80\x80\x80");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->colour, RadianceColour::xyze);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(header->to_linear_rec709[c], xyz_to_rec709()[c] / std::exp2(1 + c));
  }
  EXPECT_THAT(header->warnings, ElementsAre(HasSubstr("179")));
}

TEST_F(RadianceHeaders, ResolutionsThatAreNone) {
  for (const std::string line :
       {"", "-Y 1", "-Y 1 +X", "-Y 1 +X 0", "-Y -1 +X 1", "-Y 1 -Y 1", "+X 1 +X 1", "-Z 1 +X 1",
        "-Y 1 +X 1 1", "-Y4 +X8888888A'8", "Y 1 X 1", "-Y 1.5 +X 2", "-Y 99999999999999999999 +X 1",
        "-Y 1 +X 1x"}) {
    const auto header = parse(test::radiance_header(line) + std::string(64, '\x80'));
    ASSERT_FALSE(header) << line;
    EXPECT_EQ(header.error().code, ErrorCode::malformed) << line;
    EXPECT_THAT(header.error().what, HasSubstr("resolution")) << line;
  }
  EXPECT_EQ(parse("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1").error().code,
            ErrorCode::malformed)
      << "no end of the line";
  EXPECT_EQ(parse("#?RADIANCE\n" + std::string(100000, 'x')).error().code, ErrorCode::malformed);
}

// A few bytes that claim a large picture are refused before anything is made for it.
TEST_F(RadianceHeaders, ClaimsAreCheckedAgainstTheFile) {
  const auto claim = [&](const std::string& resolution) {
    const auto header = parse(test::radiance_header(resolution));
    return header ? "read" : header.error().what;
  };
  EXPECT_THAT(claim("-Y 99999 +X 99999"), HasSubstr("bytes"));
  EXPECT_THAT(claim("-Y 1 +X 1"), HasSubstr("at least 4 bytes"));
  EXPECT_THAT(claim("-Y 262145 +X 1"), HasSubstr("not read"));
  EXPECT_THAT(claim("+X 1 -Y 999999999"), HasSubstr("not read"));
  EXPECT_THAT(claim("-Y 262144 +X 262144"), HasSubstr("not read"));
}

}  // namespace
}  // namespace shoal
