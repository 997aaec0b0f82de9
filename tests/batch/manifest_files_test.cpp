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
        ^ say file: PATH or files: PATTERN
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
            R"()");
}

TEST_F(ManifestFiles, SameName) {
  touch({"one/p.hdr", "two/p.hdr", "one/q.hdr", "two/q.hdr", "a.hdr", "b.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - files: "one/*.hdr"
  - files: "two/*.hdr"
  - {file: a.hdr, name: x}
  - {file: b.hdr, name: x}
)"),
            R"()");
}

TEST_F(ManifestFiles, SameFile) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - files: "*.hdr"
  - file: a.hdr
)"),
            R"()");
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
            R"()");
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
)"),
            R"()");
}

TEST_F(ManifestFiles, MapsOfTwoPanoramas) {
  touch({"a.hdr", "a.dark.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas: [{file: a.hdr}, {file: a.dark.hdr}]
variants: {dark: {exposure: -1}, radiance: {}}
maps: [{kind: radiance}, {kind: radiance, suffix: radiance}]
)"),
            R"()");
}

TEST_F(ManifestFiles, NpyOfTwoDegrees) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
defaults: {degree: 2}
panoramas: [{file: a.hdr}, {file: b.hdr, degree: 3}]
tables: [csv, npy]
)"),
            R"()");
}

}  // namespace
}  // namespace shoal
