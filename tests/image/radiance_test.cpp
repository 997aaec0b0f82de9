// The Radiance reader: scanline encodings, orientations, bands, real files.
#include "image/radiance_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "image/radiance_header.h"
#include "image/radiance_rle.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"

namespace shoal {
namespace {

using test::PanoramaPixels;
using test::RowCoding;
using test::Scanline;
using test::Texel;

std::vector<Texel> joined(const std::vector<Scanline>& rows) {
  std::vector<Texel> texels;
  for (const auto& row : rows) texels.insert(texels.end(), row.begin(), row.end());
  return texels;
}

class Radiance : public ::testing::Test {
 protected:
  Result<PanoramaPixels> read(const std::string& bytes, const ReadOptions& options = {}) {
    test::write_bytes(file_, bytes);
    return test::read_all(open_radiance(file_, options));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "picture.hdr";
  test::RandomNumbers random_{7};
};

// Round trip through each encoding alone and through all of them in one file. The widths go around
// the limits of new RLE (8, 32767), of its runs (127, 128) and of old RLE's digits (256, 65536).
TEST_F(Radiance, EveryEncodingOfEveryWidth) {
  std::vector<int> widths = {127,  128,   129,   255,   256,   257,   258,
                             1024, 32766, 32767, 32768, 65536, 65537, 65538};
  for (int width = 1; width <= 40; ++width) widths.push_back(width);
  for (const int width : widths) {
    std::vector<Scanline> rows;
    for (int y = 0; y < 6; ++y) rows.push_back(test::random_scanline(random_, width));
    rows[4].assign(width, test::random_texel(random_));  // the longest run there is
    for (const int coding : {0, 1, 2, 3}) {              // 3: each row another one
      std::string bytes = test::radiance_header(test::usual_resolution(width, 6));
      for (int y = 0; y < 6; ++y) {
        auto row_coding = static_cast<RowCoding>(coding == 3 ? y % 3 : coding);
        if (!test::allows_new_rle(width) && row_coding == RowCoding::new_rle) {
          row_coding = RowCoding::flat;
        }
        bytes += test::coded_row(rows[y], row_coding);
      }
      const auto pixels = read(bytes);
      ASSERT_TRUE(pixels) << pixels.error().text();
      ASSERT_EQ(pixels->texels, joined(rows)) << "width " << width << ", coding " << coding;
    }
  }
}

// The encoding of a row that is longer than what the reader holds of the file at a time.
TEST_F(Radiance, RowsLongerThanTheWindow) {
  for (const int width : {5000, 200000}) {
    std::vector<Scanline> rows;
    for (int y = 0; y < 40000 / (width / 5); ++y) {
      Scanline row(width);
      for (auto& texel : row) texel = test::random_texel(random_);
      rows.push_back(std::move(row));
    }
    std::string bytes =
        test::radiance_header(test::usual_resolution(width, static_cast<int>(rows.size())));
    for (std::size_t y = 0; y < rows.size(); ++y) {
      bytes += y % 2 == 0 && test::allows_new_rle(width) ? test::new_rle_row(rows[y])
                                                         : test::flat_row(rows[y]);
    }
    const auto pixels = read(bytes);
    ASSERT_TRUE(pixels) << pixels.error().text();
    EXPECT_EQ(pixels->texels, joined(rows)) << "width " << width;
  }
}

// Every exponent with every mantissa comes through, and its sample type says how to read it.
TEST_F(Radiance, EveryTexelAndBothDecodes) {
  std::string bytes = test::radiance_header(test::usual_resolution(256, 256));
  std::vector<Scanline> rows(256, Scanline(256));
  for (int e = 0; e < 256; ++e) {
    for (int m = 0; m < 256; ++m) {
      rows[e][m] = {static_cast<std::uint8_t>(m), static_cast<std::uint8_t>(255 - m), 200,
                    static_cast<std::uint8_t>(e)};
    }
    bytes += test::new_rle_row(rows[e]);
  }
  for (const auto decode : {RgbeDecode::floor, RgbeDecode::center}) {
    ReadOptions options;
    options.rgbe_decode = decode;
    const auto pixels = read(bytes, options);
    ASSERT_TRUE(pixels) << pixels.error().text();
    EXPECT_EQ(pixels->texels, joined(rows));
    const double bias = decode == RgbeDecode::center ? 0.5 : 0.0;
    const std::size_t at = (std::size_t{130} * 256 + 77) * 3;  // e = 130: 2^2
    EXPECT_EQ(pixels->values[at], static_cast<float>((77 + bias) / 256 * 4));
    EXPECT_EQ(pixels->values[77 * 3 + 2], 0.0f) << "e = 0 is black whatever the mantissas are";
  }
}

// A picture whose texels name their own place, stored in all eight ways: always the same picture.
TEST_F(Radiance, EightOrientations) {
  constexpr int kWidth = 13, kHeight = 9;
  const auto texel = [](int x, int y) {
    return Texel{static_cast<std::uint8_t>(128 + x), static_cast<std::uint8_t>(y), 7, 129};
  };
  std::vector<Texel> expected;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) expected.push_back(texel(x, y));
  }
  for (const bool y_major : {true, false}) {
    for (const char y_sign : {'-', '+'}) {
      for (const char x_sign : {'-', '+'}) {
        const auto y_axis = std::string(1, y_sign) + "Y " + std::to_string(kHeight);
        const auto x_axis = std::string(1, x_sign) + "X " + std::to_string(kWidth);
        const auto resolution = y_major ? y_axis + ' ' + x_axis : x_axis + ' ' + y_axis;
        const auto file_y = [&](int i) { return y_sign == '-' ? i : kHeight - 1 - i; };
        const auto file_x = [&](int i) { return x_sign == '+' ? i : kWidth - 1 - i; };
        std::string bytes = test::radiance_header(resolution);
        for (int line = 0; line < (y_major ? kHeight : kWidth); ++line) {
          Scanline row;
          for (int i = 0; i < (y_major ? kWidth : kHeight); ++i) {
            row.push_back(y_major ? texel(file_x(i), file_y(line))
                                  : texel(file_x(line), file_y(i)));
          }
          bytes += test::coded_row(row, static_cast<RowCoding>(line % 3));
        }
        for (const int rows_per_band : {0, 1, 2, 4, 1000}) {
          ReadOptions options;
          options.rows_per_band = rows_per_band;
          const auto pixels = read(bytes, options);
          ASSERT_TRUE(pixels) << resolution << pixels.error().text();
          EXPECT_EQ(pixels->width, kWidth) << resolution;
          EXPECT_EQ(pixels->height, kHeight) << resolution;
          EXPECT_EQ(pixels->texels, expected) << resolution << " in bands of " << rows_per_band;
        }
      }
    }
  }
}

// Bands come as the file has them; each says where in the picture it belongs, rows ascending.
TEST_F(Radiance, BandsOfAFileThatStartsAtTheBottom) {
  std::string bytes = test::radiance_header("+Y 5 -X 3");
  for (int y = 4; y >= 0; --y) {
    bytes += test::flat_row(Scanline(3, {128, static_cast<std::uint8_t>(y), 0, 128}));
  }
  test::write_bytes(file_, bytes);
  ReadOptions options;
  options.rows_per_band = 2;
  const auto source = open_radiance(file_, options);
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().band_access, BandAccess::random);
  EXPECT_TRUE((*source)->info().samples_reversed);
  EXPECT_EQ((*source)->info().band_count, 3);
  const auto reader = (*source)->new_reader();
  ASSERT_TRUE(reader);
  for (const auto& [index, begin, end] : {std::array{0, 3, 5}, {1, 1, 3}, {2, 0, 1}}) {
    const auto band = (*reader)->read(index);
    ASSERT_TRUE(band);
    EXPECT_EQ(band->row_begin, begin);
    EXPECT_EQ(band->row_end, end);
    for (int row = 0; row < band->row_count(); ++row) {
      EXPECT_EQ(std::to_integer<int>(band->channels[1].row(row)[2]), begin + row);
    }
  }
  const auto second = (*source)->new_reader();  // has a place in the file of its own
  EXPECT_EQ((*second)->read(1)->row_begin, 1);
  EXPECT_EQ((*second)->read(0)->row_begin, 3);
}

// A reader that wants a band farther on goes through those before, unless another has; whichever way it
// comes to a band, the band is the same. All encodings are skipped as they are expanded.
TEST_F(Radiance, BandsInAnyOrderFromAnyReader) {
  constexpr int kRows = 40;
  constexpr int kWidth = 300;
  std::string bytes = test::radiance_header(test::usual_resolution(kWidth, kRows));
  for (int row = 0; row < kRows; ++row) {
    bytes += test::coded_row(test::random_scanline(random_, kWidth),
                             static_cast<RowCoding>(random_.below(3)));
  }
  test::write_bytes(file_, bytes);
  ReadOptions options;
  options.rows_per_band = 3;
  const auto first_row_of = [](BandReader& reader, int index) {
    const auto band = reader.read(index);
    EXPECT_TRUE(band) << band.error().text();
    std::vector<std::byte> texels;
    for (const Plane& plane : {band->channels[0], band->channels[1], band->channels[2],
                               band->exponent}) {
      for (int row = 0; row < band->row_count(); ++row) {
        texels.insert(texels.end(), plane.row(row), plane.row(row) + kWidth);
      }
    }
    return texels;
  };
  std::vector<std::vector<std::byte>> expected;
  const auto in_order = open_radiance(file_, options);
  ASSERT_TRUE(in_order) << in_order.error().text();
  const int count = (*in_order)->info().band_count;
  auto reader = (*in_order)->new_reader();
  for (int i = 0; i < count; ++i) expected.push_back(first_row_of(**reader, i));
  for (int attempt = 0; attempt < 10; ++attempt) {
    const auto source = open_radiance(file_, options);
    ASSERT_TRUE(source);
    auto one = (*source)->new_reader();
    auto other = (*source)->new_reader();
    for (int i = 0; i < 2 * count; ++i) {
      const int index = random_.below(count);
      EXPECT_TRUE(first_row_of(i % 2 == 0 ? **one : **other, index) == expected[index]) << index;
    }
  }
}

TEST_F(Radiance, OnePixelAndWhatStandsBehindIt) {
  const auto pixels = read(test::radiance_header("-Y 1 +X 1") + "\x80\x40\x20\x81" + "rubbish");
  ASSERT_TRUE(pixels) << pixels.error().text();
  EXPECT_THAT(pixels->values, ::testing::ElementsAre(1.0f, 0.5f, 0.25f));
}

// The bound that guards against small files with large claims is attained: a row of one value, in
// the better of the two run-length encodings, takes exactly so many bytes.
TEST_F(Radiance, SmallestScanlineIsAttained) {
  for (const int width :
       {1, 2, 7, 8, 9, 127, 128, 255, 256, 257, 258, 1024, 32767, 32768, 65536, 65537, 1 << 18}) {
    const Scanline row(width, {128, 128, 128, 128});
    std::size_t smallest = test::old_rle_row(row).size();
    if (test::allows_new_rle(width)) {
      smallest = std::min(smallest, test::new_rle_row(row).size());
    }
    EXPECT_EQ(smallest_radiance_scanline(width), smallest) << "width " << width;
  }
}

// A flat file of a writer that does not normalise: 1, 1, 1, n and 2, 2, .. are texels there, as the
// file's size tells. With one byte more behind it, nothing tells, and the format's rules hold.
TEST_F(Radiance, FlatFilesMayHoldTexelsThatLookLikeMarks) {
  const Scanline row = {{2, 2, 7, 128}, {1, 1, 1, 128}, {1, 1, 1, 1}, {1, 1, 1, 0}, {9, 9, 9, 3},
                        {1, 1, 1, 255}, {2, 2, 0, 9},   {5, 5, 5, 5}, {6, 6, 6, 6}};
  const std::string bytes = test::radiance_header("-Y 1 +X 9") + test::flat_row(row);
  const auto pixels = read(bytes);
  ASSERT_TRUE(pixels) << pixels.error().text();
  Scanline expected = row;
  expected[2] = row[1];  // n = 1 keeps its meaning: one repeat takes the room of one texel
  EXPECT_EQ(pixels->texels, expected);
  EXPECT_FALSE(read(bytes + "x"));
}

// A file of 1991: its rows, expanded one after another, take every byte that it has.
TEST_F(Radiance, OldRunLengthFileIsReadToItsLastByte) {
  SHOAL_REQUIRE_TEST_DATA("rgbe_variants/imagers_old-rle.hdr");
  const auto path = test::data_folder() / "rgbe_variants" / "imagers_old-rle.hdr";
  auto file = InputFile::open(path);
  ASSERT_TRUE(file);
  const auto header = read_radiance_header(*file);
  ASSERT_TRUE(header);
  ASSERT_EQ(header->scanline_width, 551);
  ASSERT_EQ(header->scanline_count, 276);
  const std::string bytes = test::read_bytes(path);
  std::vector<std::uint8_t> input(bytes.begin() + static_cast<long>(header->data_offset),
                                  bytes.end());
  std::vector<std::uint8_t> planes(4 * (551 + kRadianceSlack));
  const auto plane = [&](int c) { return planes.data() + c * (551 + kRadianceSlack); };
  std::size_t at = 0;
  for (int y = 0; y < 276; ++y) {
    const auto result = expand_radiance_scanline(std::span(input).subspan(at), 551, DataSize::any,
                                                 {plane(0), plane(1), plane(2), plane(3)});
    ASSERT_EQ(result.state, ScanlineState::whole) << y << result.fault;
    at += result.bytes;
  }
  EXPECT_EQ(at, input.size());
  EXPECT_TRUE(test::read_all(open_radiance(path, {})));
}

}  // namespace
}  // namespace shoal
