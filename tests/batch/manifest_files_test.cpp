// Files, names and outputs that cannot be: the whole text of what is told.
#include "manifest_folder.h"

namespace shoal {
namespace {

class ManifestFiles : public test::ManifestTest {};

TEST_F(ManifestFiles, EntriesWithoutFiles) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - a.hdr
  - {exposure: 1}
  - {file: a.hdr, files: b.hdr}
  - {files: b.hdr, name: b}
  - {file: a.hdr, exclude: b}
)"),
            R"(m.yaml:3:5: error: a panorama must be a mapping of keys to values, not "a.hdr"
      - a.hdr
        ^ write "file: PATH" or "files: PATTERN"
m.yaml:4:5: error: this entry names no panorama
      - {exposure: 1}
        ^ say file: PATH, files: PATTERN, sky: MAPPING, or lights: LIST
m.yaml:5:5: error: an entry names either file or files
      - {file: a.hdr, files: b.hdr}
        ^ make it two entries
m.yaml:6:5: error: name goes with file, not with files
      - {files: b.hdr, name: b}
        ^ files are named by their paths
m.yaml:7:5: error: exclude goes with files, not with file
      - {file: a.hdr, exclude: b}
        ^ leave it out
)");
}

TEST_F(ManifestFiles, MissingFiles) {
  touch({"studio.exr", "lib/x.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - file: studo.exr
  - file: lib
  - file: "lib/*.hdr"
  - file: nowhere/a.hdr
)"),
            R"(m.yaml:3:11: error: no file "studo.exr"
      - file: studo.exr
              ^ did you mean "studio.exr"?
m.yaml:4:11: error: "lib" is a folder
      - file: lib
              ^ files: "FOLDER/*.hdr" takes what lies in it
m.yaml:5:11: error: no file "lib/*.hdr"
      - file: "lib/*.hdr"
              ^ patterns go under files:
m.yaml:6:11: error: no file "nowhere/a.hdr"
      - file: nowhere/a.hdr
              ^ nowhere: No such file or directory
)");
}

TEST_F(ManifestFiles, GlobsWithoutMatch) {
  touch({"lib/x.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - files: "*.hdr"
  - files: "lib/*.exr"
  - files: "nowhere/*.hdr"
  - files: "lib/[a.hdr"
  - {files: "lib/*", exclude: "*.hdr"}
  - {files: "lib/**", exclude: "old/**"}
)"),
            R"(m.yaml:3:12: error: no file matches "*.hdr"
      - files: "*.hdr"
               ^ in folders below there are some: "**/*.hdr"
m.yaml:4:12: error: no file matches "lib/*.exr"
      - files: "lib/*.exr"
               ^
m.yaml:5:12: error: no file matches "nowhere/*.hdr"
      - files: "nowhere/*.hdr"
               ^ nowhere/: No such file or directory
m.yaml:6:12: error: a [ has no closing ]
      - files: "lib/[a.hdr"
               ^ write \[ for the character itself
m.yaml:7:13: error: every file that matches is excluded
      - {files: "lib/*", exclude: "*.hdr"}
                ^
m.yaml:8:32: warning: "old/**" excludes nothing
      - {files: "lib/**", exclude: "old/**"}
                                   ^ patterns see the path below the first folder with a wildcard
)");
}

TEST_F(ManifestFiles, SameName) {
  touch({"one/p.hdr", "two/p.hdr", "one/q.hdr", "two/q.hdr", "a.hdr", "b.hdr"});
  EXPECT_EQ(
      messages(R"(shoal: 1
panoramas:
  - files: "one/*.hdr"
  - files: "two/*.hdr"
  - {file: a.hdr, name: x}
  - {file: b.hdr, name: x}
)"),
      R"(m.yaml:4:12: error: two panoramas are named "p.hdr": "one/p.hdr" and "two/p.hdr", and 1 more like it
      - files: "two/*.hdr"
               ^ the first is of m.yaml:3:12; exclude one, or give it a name
m.yaml:6:25: error: two panoramas are named "x": "a.hdr" and "b.hdr"
      - {file: b.hdr, name: x}
                            ^ the first is of m.yaml:5:5; exclude one, or give it a name
)");
}

TEST_F(ManifestFiles, SameFile) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - files: "*.hdr"
  - file: a.hdr
)"),
            R"(m.yaml:4:5: error: "a.hdr" is taken twice
      - file: a.hdr
        ^ the first is of m.yaml:3:12; exclude one, or give it a name
)");
}

TEST_F(ManifestFiles, UnsafeNames) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - {file: a.hdr, name: ../a}
  - {file: a.hdr, name: /a}
  - {file: a.hdr, name: b//a}
  - {file: a.hdr, name: "a\tb"}
  - {file: a.hdr, name: ""}
)"),
            R"(m.yaml:3:25: error: the name "../a" leads out of the output folder
      - {file: a.hdr, name: ../a}
                            ^
m.yaml:4:25: error: the name "/a" begins with a slash
      - {file: a.hdr, name: /a}
                            ^
m.yaml:5:25: error: the name "b//a" has an empty part
      - {file: a.hdr, name: b//a}
                            ^
m.yaml:6:25: error: the name "a\x09b" holds control characters
      - {file: a.hdr, name: "a\tb"}
                            ^
m.yaml:7:25: error: the name "" has an empty part
      - {file: a.hdr, name: ""}
                            ^
)");
}

TEST_F(ManifestFiles, Maps) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas: [{file: a.hdr}]
maps:
  - {kind: irradiance}
  - {kind: irradiance, size: [64, 32]}
  - {size: [64, 32]}
  - {kind: radiance, size: 32}
  - {kind: radiance, layout: cube, size: [64, 32], suffix: a.b}
  - {kind: radiance, format: hdr, type: float, faces: files, exposure: 1}
  - {kind: radiance, size: [0, 1.5], suffix: x}
  - {kind: radiance, layout: cube-openexr, format: hdr}
)"),
            R"(m.yaml:5:5: error: two maps would be written to "maps/NAME.irradiance.exr"
      - {kind: irradiance, size: [64, 32]}
        ^ give one a suffix; the first is on line 4
m.yaml:6:5: error: a map needs its kind
      - {size: [64, 32]}
        ^ kind: irradiance, radiance or irradiance_over_pi
m.yaml:7:28: error: size must be a list of two: width and height, not "32"
      - {kind: radiance, size: 32}
                               ^
m.yaml:8:42: error: size must be a whole number from 1 to 4096, not a list
      - {kind: radiance, layout: cube, size: [64, 32], suffix: a.b}
                                             ^
m.yaml:8:60: error: "a.b" cannot be part of a file's name here
      - {kind: radiance, layout: cube, size: [64, 32], suffix: a.b}
                                                               ^ use letters, digits, - and _
m.yaml:9:35: error: type is for format: exr only
      - {kind: radiance, format: hdr, type: float, faces: files, exposure: 1}
                                      ^ leave it out
m.yaml:9:48: error: faces is for layout: cube only
      - {kind: radiance, format: hdr, type: float, faces: files, exposure: 1}
                                                   ^ leave it out
m.yaml:9:62: error: exposure is for format: png only
      - {kind: radiance, format: hdr, type: float, faces: files, exposure: 1}
                                                                 ^ leave it out
m.yaml:10:29: error: an item of size must be a whole number from 1 to 16384, not "0"
      - {kind: radiance, size: [0, 1.5], suffix: x}
                                ^
m.yaml:11:52: error: layout: cube-openexr is for format: exr only
      - {kind: radiance, layout: cube-openexr, format: hdr}
                                                       ^ its faces are told by EXR's envmap attribute; take cube-vertical-strip
)");
}

TEST_F(ManifestFiles, MapsOfTwoPanoramas) {
  touch({"a.hdr", "a.dark.hdr"});
  EXPECT_EQ(
      messages(R"(shoal: 1
panoramas: [{file: a.hdr}, {file: a.dark.hdr}]
variants: {dark: {exposure: -1}, radiance: {}}
maps: [{kind: radiance}, {kind: radiance, suffix: radiance}]
)"),
      R"(m.yaml:2:28: error: files of the panoramas "a" and "a.dark" would both be written to "maps/a.dark.radiance.radiance.exr"
    panoramas: [{file: a.hdr}, {file: a.dark.hdr}]
                               ^ give one of the panoramas another name
)");
}

TEST_F(ManifestFiles, NpyOfTwoDegrees) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
defaults: {degree: 2}
panoramas: [{file: a.hdr}, {file: b.hdr, degree: 3}]
tables: [csv, npy]
)"),
            R"(m.yaml:4:9: error: an npy table has one degree, but "a" has 2 and "b" has 3
    tables: [csv, npy]
            ^ leave npy out, or use one degree
)");
}

}  // namespace
}  // namespace shoal
