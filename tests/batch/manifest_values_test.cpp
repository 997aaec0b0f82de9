// Keys and values that make no sense: the whole text of what is told.
#include "manifest_folder.h"

namespace shoal {
namespace {

class ManifestValues : public test::ManifestTest {};

TEST_F(ManifestValues, UnknownKeys) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
outptu: out
defaults: {quadratur: texel}
degree: 4
panoramas:
  - {file: a.hdr}
variants: {soft: {zzz: 1}}
)"),
            R"(m.yaml:2:1: error: unknown key "outptu" in the manifest's top level
    outptu: out
    ^ did you mean "output"?
m.yaml:3:12: error: unknown key "quadratur" in defaults
    defaults: {quadratur: texel}
               ^ did you mean "quadrature"?
m.yaml:4:1: error: unknown key "degree" in the manifest's top level
    degree: 4
    ^ it belongs to a panorama or defaults
m.yaml:7:19: error: unknown key "zzz" in a variant
    variants: {soft: {zzz: 1}}
                      ^ known here: mirror, exposure, scale, matrix, white, frame, rotate, window, dominant, views
)");
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
            R"(m.yaml:4:13: error: degree must be a whole number from 0 to 64, not "65"
        degree: 65
                ^
m.yaml:5:12: error: scale must be a number above 0, not "0"
        scale: 0
               ^
m.yaml:6:12: error: clamp must be a number that is not negative, not "-1"
        clamp: -1
               ^
m.yaml:7:15: error: exposure must be a number of stops from -100 to 100, not "1000"
        exposure: 1000
                  ^
m.yaml:8:16: error: an item of white must be a number above 0, not "0"
        white: [1, 0, 1]
                   ^
)");
}

TEST_F(ManifestValues, WrongTypes) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - file: [a.hdr]
    degree: two
    exposure: 1.5 EV
    scale: nan
    clamp: [3]
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
m.yaml:7:12: error: clamp must be a number that is not negative, not a list
        clamp: [3]
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
            R"(m.yaml:2:24: error: quadrature must be texel, midpoint or fejer, not "texle"
    defaults: {quadrature: texle, nonfinite: ignore, encoding: sRGB}
                           ^ did you mean "texel"?
m.yaml:2:42: error: nonfinite must be error or zero, not "ignore"
    defaults: {quadrature: texle, nonfinite: ignore, encoding: sRGB}
                                             ^
m.yaml:2:60: error: encoding must be srgb or linear, not "sRGB"
    defaults: {quadrature: texle, nonfinite: ignore, encoding: sRGB}
                                                               ^
m.yaml:4:26: error: quantities names "irradiance" twice
    quantities: [irradiance, irradiance]
                             ^
m.yaml:5:10: error: tables must be csv, json, npy, quality or lights, not "cvs"
    tables: [cvs]
             ^ did you mean "csv"?
)");
}

TEST_F(ManifestValues, Frames) {
  touch({"a.hdr", "b.hdr", "c.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - {file: a.hdr, frame: opnexr}
  - {file: b.hdr, frame: {center: +z, right: -z, up: +y}}
  - {file: c.hdr, frame: {center: +z, up: +y}}
)"),
            R"(m.yaml:3:26: error: unknown frame "opnexr"
      - {file: a.hdr, frame: opnexr}
                             ^ did you mean "openexr"?
m.yaml:4:26: error: the frame +z,-z,+y uses an axis twice
      - {file: b.hdr, frame: {center: +z, right: -z, up: +y}}
                             ^ centre, right and up lie on three different axes, such as +z,-x,+y
m.yaml:5:26: error: a frame needs center, right and up
      - {file: c.hdr, frame: {center: +z, up: +y}}
                             ^ such as {center: +z, right: -x, up: +y}
)");
}

TEST_F(ManifestValues, Variants) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas: [{file: a.hdr}]
variants: {a.b: {}, dark: {exposure: dark, degree: 3}, dark: {}}
)"),
            R"(m.yaml:3:12: error: "a.b" cannot be a variant's name
    variants: {a.b: {}, dark: {exposure: dark, degree: 3}, dark: {}}
               ^ use letters, digits, - and _
m.yaml:3:38: error: exposure must be a number of stops from -100 to 100, not "dark"
    variants: {a.b: {}, dark: {exposure: dark, degree: 3}, dark: {}}
                                         ^
m.yaml:3:44: error: unknown key "degree" in a variant
    variants: {a.b: {}, dark: {exposure: dark, degree: 3}, dark: {}}
                                               ^ it belongs to a panorama or defaults
m.yaml:3:56: error: the key "dark" is given twice
    variants: {a.b: {}, dark: {exposure: dark, degree: 3}, dark: {}}
                                                           ^ first on line 3
)");
}

TEST_F(ManifestValues, InfiniteColours) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - {file: a.hdr, scale: 1e300, exposure: 100}
)"),
            R"(m.yaml:3:5: error: exposure, scale and colour matrix together are not finite
      - {file: a.hdr, scale: 1e300, exposure: 100}
        ^ check their values
)");
}

}  // namespace
}  // namespace shoal
