// One Radiance file read by several workers at once: the same scanlines and the same errors as one
// worker reads, whatever the bytes make them guess.
#include "image/radiance_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <thread>

#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "image/radiance_source.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::RowCoding;
using test::Scanline;
using test::Texel;

TEST(RadiancePieces, BordersCutAllBytesOnce) {
  for (const std::uint64_t bytes : {1, 9, 10, 11, 100}) {
    for (const std::uint64_t piece_bytes :
         {std::uint64_t{1}, std::uint64_t{10}, ~std::uint64_t{0}}) {
      const RadiancePieces pieces({1000, 1000 + bytes, piece_bytes, 7, 3});
      EXPECT_EQ(pieces.bytes_begin(0), 1000u);
      EXPECT_EQ(pieces.bytes_end(pieces.count() - 1), 1000 + bytes);
      for (int k = 1; k < pieces.count(); ++k) {
        EXPECT_EQ(pieces.bytes_begin(k), pieces.bytes_end(k - 1));
      }
    }
  }
}

TEST(RadiancePieces, ARunIsProvenByTheOneBeforeIt) {
  RadiancePieces pieces({0, 100, 25, 10, 10});
  pieces.tell(2, {55, 80, 2});
  pieces.tell(1, {31, 55, 3});
  EXPECT_FALSE(pieces.start(1));
  pieces.tell(0, {0, 31, 4});
  EXPECT_EQ(pieces.start(1)->offset, 31u);
  EXPECT_EQ(pieces.start(3)->offset, 80u);
  EXPECT_EQ(pieces.start(3)->scanline, 9);
}

TEST(RadiancePieces, ARunThatBeginsElsewhereCountsForNothing) {
  RadiancePieces pieces({0, 100, 25, 10, 10});
  pieces.tell(1, {30, 55, 3, "is rubbish"});
  pieces.tell(0, {0, 31, 4});
  EXPECT_FALSE(pieces.start(2));
  pieces.tell(1, {31, 54, 2});
  EXPECT_EQ(pieces.start(2)->offset, 54u);
  EXPECT_EQ(pieces.start(2)->scanline, 6);
}

// What stands behind the picture's last scanline is nobody's fault.
TEST(RadiancePieces, FaultsCountWithinThePicture) {
  for (const int good : {5, 6, 7}) {
    RadiancePieces pieces({0, 100, 25, 10, 10});
    pieces.tell(1, {31, 54, good, "is rubbish"});
    pieces.tell(0, {0, 31, 4});
    const auto known = pieces.wait_for_start(2);
    EXPECT_EQ(known.broken.has_value(), good < 6) << good;
    if (known.broken) {
      EXPECT_EQ(known.broken->scanline, 4 + good);
    } else {
      EXPECT_EQ(known.start->scanline, 10);
    }
  }
}

TEST(RadiancePieces, WhoWaitsIsToldWhatNobodyDoes) {
  RadiancePieces pieces({0, 100, 25, 10, 10});
  const RadiancePieces::Claim claim(pieces, 3);
  EXPECT_EQ(pieces.wait_for_start(3).missing, 0);
  pieces.tell(0, {0, 31, 4});
  EXPECT_EQ(pieces.wait_for_start(3).missing, 1);
  std::jthread other;
  {
    const RadiancePieces::Claim others(pieces, 1);
    other = std::jthread([&] {  // gives up its claim, or tells: either ends the wait below
      pieces.tell(1, {31, 54, 2});
    });
    EXPECT_EQ(pieces.wait_for_start(3).missing, 2);
  }
}

// What some workers together found: the picture, or the errors that they met.
struct Findings {
  std::vector<Texel> texels;
  std::vector<int> seen;  // how often each scanline came
  std::vector<std::string> errors;
};

class RadianceWorkers : public ::testing::Test {
 protected:
  Findings read(int workers, const RadianceCut& cut) {
    const auto source = open_radiance(file_, {}, cut);
    EXPECT_TRUE(source) << source.error().text();
    const PictureInfo& info = (*source)->info();
    Findings found;
    found.texels.resize(static_cast<std::size_t>(info.width) * info.height);
    found.seen.resize(info.height);
    std::atomic<int> next{0};
    std::mutex mutex;
    std::barrier together(workers);
    const auto work = [&] {
      auto reader = (*source)->new_reader();
      together.arrive_and_wait();
      for (int index = next++; index < info.band_count; index = next++) {
        const auto band = (*reader)->read(index);
        const std::scoped_lock lock(mutex);
        if (!band) {
          found.errors.push_back(band.error().text());
          return;
        }
        keep(*band, info.rows_per_band, found);
      }
    };
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < workers; ++i) threads.emplace_back(work);
    }
    return found;
  }

  static void keep(const RowBand& band, int most_rows, Findings& found) {
    EXPECT_LE(band.row_count(), most_rows);
    for (int row = 0; row < band.row_count(); ++row) {
      ++found.seen[band.row_begin + row];
      for (int i = 0; i < band.width; ++i) {
        Texel& texel =
            found.texels[static_cast<std::size_t>(band.row_begin + row) * band.width + i];
        for (int c = 0; c < 3; ++c) {
          texel[c] = std::to_integer<std::uint8_t>(band.channels[c].row(row)[i]);
        }
        texel[3] = std::to_integer<std::uint8_t>(band.exponent.row(row)[i]);
      }
    }
  }

  // Any number of workers, pieces of any size: the picture is `rows`.
  void expect_picture(const std::string& bytes, const std::vector<Scanline>& rows) {
    test::write_bytes(file_, bytes);
    std::vector<Texel> expected;
    for (const auto& row : rows) expected.insert(expected.end(), row.begin(), row.end());
    for (const auto& cut : cuts(bytes.size())) {
      for (const int workers : {1, 2, 3, 8}) {
        const Findings found = read(workers, cut);
        EXPECT_THAT(found.errors, ::testing::IsEmpty());
        EXPECT_EQ(found.seen, std::vector<int>(rows.size(), 1));
        EXPECT_TRUE(found.texels == expected)
            << workers << " workers, pieces of " << cut.piece_bytes << " bytes and at most "
            << cut.max_scanlines << " scanlines";
      }
    }
  }

  // Any number of workers, pieces of any size: the error is what one band from top to bottom gives.
  void expect_one_error(const std::string& bytes) {
    test::write_bytes(file_, bytes);
    const RadianceCut whole{~std::uint64_t{0}, 1 << 20};
    const Findings expected = read(1, whole);
    ASSERT_EQ(expected.errors.size(), 1u);
    for (const auto& cut : cuts(bytes.size())) {
      for (const int workers : {1, 2, 3, 8}) {
        const Findings found = read(workers, cut);
        EXPECT_THAT(found.errors, ::testing::Not(::testing::IsEmpty()));
        EXPECT_THAT(found.errors, ::testing::Each(expected.errors[0]))
            << workers << " workers, pieces of " << cut.piece_bytes << " bytes";
      }
    }
  }

  static std::vector<RadianceCut> cuts(std::size_t file_bytes) {
    std::vector<RadianceCut> cuts;
    for (const std::size_t piece_bytes : {file_bytes / 40 + 1, file_bytes / 7 + 1, file_bytes}) {
      for (const int max_scanlines : {1, 3, 1000}) cuts.push_back({piece_bytes, max_scanlines});
    }
    return cuts;
  }

  std::vector<Scanline> random_rows(int width, int height) {
    std::vector<Scanline> rows;
    for (int y = 0; y < height; ++y) rows.push_back(test::random_scanline(random_, width));
    return rows;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "picture.hdr";
  test::RandomNumbers random_{5};
};

std::string file_of(const std::vector<Scanline>& rows, const auto& coding_of_row) {
  std::string bytes = test::radiance_header(
      test::usual_resolution(static_cast<int>(rows[0].size()), static_cast<int>(rows.size())));
  for (std::size_t y = 0; y < rows.size(); ++y) {
    bytes += test::coded_row(rows[y], coding_of_row(static_cast<int>(y)));
  }
  return bytes;
}

std::string new_rle_file(const std::vector<Scanline>& rows) {
  return file_of(rows, [](int) { return RowCoding::new_rle; });
}

TEST_F(RadianceWorkers, AnyEncodingOfAnySize) {
  for (const int width : {1, 8, 13, 128, 1001}) {
    for (const int height : {1, 2, 57}) {
      const auto rows = random_rows(width, height);
      for (const auto coding : {RowCoding::flat, RowCoding::old_rle, RowCoding::new_rle}) {
        if (coding == RowCoding::new_rle && !test::allows_new_rle(width)) continue;
        expect_picture(file_of(rows, [&](int) { return coding; }), rows);
      }
    }
  }
}

// No scanline tells how the next one is encoded.
TEST_F(RadianceWorkers, EncodingsThatChange) {
  const auto rows = random_rows(200, 90);
  for (const int first : {0, 1, 2}) {
    expect_picture(
        file_of(rows, [&](int y) { return static_cast<RowCoding>((first + y / 9) % 3); }), rows);
  }
}

// Half of the picture takes next to no bytes, so that its pieces have more scanlines than they may.
TEST_F(RadianceWorkers, ScanlinesThatTakeVeryDifferentRoom) {
  auto rows = random_rows(300, 80);
  for (int y = 20; y < 60; ++y) rows[y].assign(300, {0, 0, 0, 0});
  expect_picture(new_rle_file(rows), rows);
}

TEST_F(RadianceWorkers, RubbishBehindThePicture) {
  const auto rows = random_rows(100, 30);
  const std::string bytes = new_rle_file(rows);
  expect_picture(bytes + "x", rows);
  expect_picture(bytes + std::string(3000, '\2'), rows);
  for (int i = 0; i < 3; ++i) {  // that even looks like more scanlines
    expect_picture(bytes + test::new_rle_row(random_rows(100, 1)[0]) + std::string(i, '\1'), rows);
  }
}

// The bytes that begin a scanline, in the middle of scanlines: as literals, as runs, and between.
TEST_F(RadianceWorkers, MarkersThatAreNone) {
  constexpr int kWidth = 514;  // 2, 2, 2, 2 is its marker
  auto rows = random_rows(kWidth, 60);
  for (auto& row : rows) {
    for (int i = 0; i < kWidth; ++i) {
      if (random_.below(2) == 0) row[i][random_.below(4)] = 2;
    }
  }
  expect_picture(new_rle_file(rows), rows);
  for (auto& row : rows) row.assign(kWidth, {2, 2, 2, 2});
  expect_picture(new_rle_file(rows), rows);
}

// Literals of 127 texels make a scanline of 4 + 4 * 128 bytes. Bytes in them are set so that,
// begun `shift` bytes later, the whole file is a sequence of perfect scanlines as well: of the same
// length, each leading to the next, to the end of the file. No worker can tell by what it sees.
class ShiftedScanlines : public RadianceWorkers, public ::testing::WithParamInterface<int> {
 protected:
  static constexpr int kWidth = 127;
  static constexpr int kRowBytes = 4 + 4 * (1 + kWidth);

  static void set_byte(Scanline& row, int offset, int value) {
    const int component = (offset - 4) / (1 + kWidth);
    const int i = (offset - 4) % (1 + kWidth) - 1;
    ASSERT_GE(i, 0) << "a code, not a literal";
    row[i][component] = static_cast<std::uint8_t>(value);
  }

  Scanline random_row() {
    Scanline row(kWidth);
    for (Texel& texel : row) texel = test::random_texel(random_);
    return row;
  }

  // A scanline in new RLE without a single run, whatever it holds.
  static std::string literals(const Scanline& row) {
    std::string bytes = {2, 2, 0, kWidth};
    for (int c = 0; c < 4; ++c) {
      bytes.push_back(kWidth);
      for (const Texel& texel : row) bytes.push_back(static_cast<char>(texel[c]));
    }
    return bytes;
  }

  void make(int height) {
    const int shift = GetParam();
    bytes_ = test::radiance_header(test::usual_resolution(kWidth, height));
    header_bytes_ = bytes_.size();
    for (int y = 0; y < height; ++y) {
      Scanline row = random_row();
      const std::string marker = {2, 2, 0, kWidth};
      for (int i = 0; i < 4; ++i) set_byte(row, shift + i, marker[i]);
      for (int c = 0; c < 4; ++c) set_byte(row, shift + 4 + c * (1 + kWidth), kWidth);
      bytes_ += literals(row);
      rows_.push_back(std::move(row));
    }
  }

  std::string bytes_;
  std::size_t header_bytes_ = 0;
  std::vector<Scanline> rows_;
};

TEST_P(ShiftedScanlines, AreNotMistakenForTheTrueOnes) {
  make(60);
  // They are what they are meant to be: the same picture without its first bytes reads well.
  const std::size_t header = header_bytes_;
  std::string shifted = test::radiance_header(test::usual_resolution(kWidth, 59));
  shifted += bytes_.substr(header + GetParam());
  test::write_bytes(file_, shifted);
  EXPECT_THAT(read(1, {1000, 10}).errors, ::testing::IsEmpty());
  expect_picture(bytes_, rows_);
}

// The scanline that is broken, or missing, lies elsewhere in the shifted picture.
TEST_P(ShiftedScanlines, DoNotBlurErrors) {
  make(60);
  expect_one_error(bytes_.substr(0, bytes_.size() - 700));
  std::string broken = bytes_;
  broken[header_bytes_ + 30 * kRowBytes + 4] = 0;  // a code
  expect_one_error(broken);
}

INSTANTIATE_TEST_SUITE_P(By, ShiftedScanlines, ::testing::Values(20, 100));

TEST_F(RadianceWorkers, MeetTheSameErrorAsOneAlone) {
  const auto rows = random_rows(150, 60);
  for (const auto coding : {RowCoding::flat, RowCoding::old_rle, RowCoding::new_rle}) {
    const std::string whole = file_of(rows, [&](int) { return coding; });
    for (const double part : {0.2, 0.5, 0.97}) {
      expect_one_error(whole.substr(0, static_cast<std::size_t>(part * whole.size()) + 60));
    }
  }
  // In the new encoding a code of 0 breaks its scanline, and leaves all others readable.
  std::string broken = test::radiance_header(test::usual_resolution(150, 60));
  std::vector<std::size_t> begins;
  for (const auto& row : rows) {
    begins.push_back(broken.size());
    broken += test::new_rle_row(row);
  }
  for (const int y : {59, 41, 40, 7, 0}) {  // the first broken one counts
    broken[begins[y] + 4] = 0;
    expect_one_error(broken);
  }
}

// Readers need not come in order, nor all of them: each band is what it is.
TEST_F(RadianceWorkers, BandsInAnyOrder) {
  const auto rows = random_rows(120, 50);
  for (const auto coding : {RowCoding::flat, RowCoding::old_rle, RowCoding::new_rle}) {
    test::write_bytes(file_, file_of(rows, [&](int) { return coding; }));
    for (int attempt = 0; attempt < 10; ++attempt) {
      const auto source = open_radiance(file_, {}, RadianceCut{900, 4});
      ASSERT_TRUE(source);
      const PictureInfo& info = (*source)->info();
      auto one = (*source)->new_reader();
      auto other = (*source)->new_reader();
      for (int i = 0; i < 20; ++i) {
        const auto band = (i % 2 == 0 ? *one : *other)->read(random_.below(info.band_count));
        ASSERT_TRUE(band) << band.error().text();
        for (int row = 0; row < band->row_count(); ++row) {
          for (int x = 0; x < band->width; ++x) {
            ASSERT_EQ(std::to_integer<int>(band->channels[1].row(row)[x]),
                      rows[band->row_begin + row][x][1]);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace shoal
