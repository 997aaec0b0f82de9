// Keys and values that make no sense: the whole text of what is told.
#include "manifest_folder.h"

namespace shoal {
namespace {

class ManifestValues : public test::ManifestTest {};

TEST_F(ManifestValues, UnknownKeys) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
outptu: out
defaults: {quadratur: texel, lights: []}
degree: 4
panoramas:
  - {file: a.hdr, zzz: 1}
)"),
            R"()");
}

TEST_F(ManifestValues, NotAvailableYet) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - {name: key, lights: [{disk: {radius: 10}}]}
  - {file: a.hdr, rotate: {yaw: 90}, layout: cube}
variants: {soft: {window: hann}}
exports: [three]
)"),
            R"()");
}

TEST_F(ManifestValues, NumbersOutOfRange) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - file: a.hdr
    degree: 65
    scale: 0
    clamp: -1
    exposure: 1000
    white: [1, 0, 1]
)"),
            R"()");
}

TEST_F(ManifestValues, WrongTypes) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - file: [a.hdr]
    degree: two
    exposure: 1.5 EV
    scale: nan
    clamp: {above: 3}
    white: 1
    matrix: [[1, 0, 0], [0, 1], [0, 0, 1]]
)"),
            R"(m.yaml:3:11: error: file must be text, not a list
      - file: [a.hdr]
              ^ put text that begins with { or [ in quotes
m.yaml:4:13: error: degree must be a whole number from 0 to 64, not "two"
        degree: two
                ^
m.yaml:5:15: error: exposure must be a number of stops from -100 to 100, not "1.5 EV"
        exposure: 1.5 EV
                  ^ write the number alone, without a unit
m.yaml:6:12: error: scale must be a number above 0, not "nan"
        scale: nan
               ^
m.yaml:7:12: error: clamp must be a number that is not negative, not a mapping
        clamp: {above: 3}
               ^
m.yaml:8:12: error: white must be a list of three numbers above 0, not "1"
        white: 1
               ^
m.yaml:9:25: error: matrix must be three lists of three numbers, the matrix's rows, not a list of 2
        matrix: [[1, 0, 0], [0, 1], [0, 0, 1]]
                            ^
)");
}

TEST_F(ManifestValues, WrongWords) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
defaults: {quadrature: texle, nonfinite: ignore, encoding: sRGB}
panoramas: [{file: a.hdr}]
quantities: [irradiance, irradiance]
tables: [cvs]
)"),
            R"()");
}

TEST_F(ManifestValues, Frames) {
  touch({"a.hdr", "b.hdr", "c.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - {file: a.hdr, frame: opnexr}
  - {file: b.hdr, frame: {center: +z, right: -z, up: +y}}
  - {file: c.hdr, frame: {center: +z, up: +y}}
)"),
            R"()");
}

TEST_F(ManifestValues, Variants) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas: [{file: a.hdr}]
variants: {a.b: {}, dark: {exposure: dark, degree: 3}, dark: {}}
)"),
            R"()");
}

TEST_F(ManifestValues, InfiniteColours) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - {file: a.hdr, scale: 1e300, exposure: 100}
)"),
            R"()");
}

}  // namespace
}  // namespace shoal
