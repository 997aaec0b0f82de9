// What is no YAML, or YAML that is no manifest: the whole text of what is told.
#include "manifest_folder.h"

namespace shoal {
namespace {

class ManifestSyntax : public test::ManifestTest {};

TEST_F(ManifestSyntax, Empty) {
  EXPECT_EQ(messages("# nothing yet\n"),
            R"(m.yaml: error: the manifest is empty
    shoal init DIR writes one for a folder of panoramas
)");
}

TEST_F(ManifestSyntax, NoMapping) {
  touch({"a.hdr", "b.hdr"});
  EXPECT_EQ(messages("- a.hdr\n- b.hdr\n"),
            R"(m.yaml:1:1: error: a manifest is a mapping of keys to values
    - a.hdr
    ^ it begins with "shoal: 1"; shoal init DIR writes one
)");
}

TEST_F(ManifestSyntax, NotText) {
  EXPECT_EQ(messages("\1\2"),
            R"(m.yaml: error: this is not text: it holds control characters
    a manifest is YAML text; shoal init DIR writes one
)");
}

TEST_F(ManifestSyntax, TabInIndentation) {
  touch({"a.hdr"});
  EXPECT_EQ(messages("shoal: 1\npanoramas:\n\t- file: a.hdr\n"),
            R"(m.yaml:3:1: error: a tab in the indentation
    	- file: a.hdr
    ^ YAML indents with spaces
)");
}

TEST_F(ManifestSyntax, PatternWithoutQuotes) {
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - files: *.hdr
)"),
            R"(m.yaml:3:12: error: a "*" begins a YAML alias here
      - files: *.hdr
               ^ put patterns in quotes: "*.hdr"
)");
}

TEST_F(ManifestSyntax, VariableWithoutQuotesInBraces) {
  EXPECT_EQ(messages("shoal: 1\npanoramas: [{files: ${library}/a}]\n"),
            R"(m.yaml:2:21: error: this "{" is not closed
    panoramas: [{files: ${library}/a}]
                        ^ put values that hold ${...} in quotes between { } or [ ]
)");
}

TEST_F(ManifestSyntax, QuoteNeverClosed) {
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - files: "*.hdr
maps: []
)"),
            R"(m.yaml:3:12: error: this quote is never closed
      - files: "*.hdr
               ^ close it at the end of the value
)");
}

TEST_F(ManifestSyntax, BracketNeverClosed) {
  EXPECT_EQ(messages("shoal: 1\ntables: [csv, json\n"),
            R"(m.yaml:2:9: error: this "[" is not closed
    tables: [csv, json
            ^ close it with "]"
)");
}

TEST_F(ManifestSyntax, SecondDocument) {
  EXPECT_EQ(messages(R"(shoal: 1
---
shoal: 1
)"),
            R"(m.yaml:2:1: error: a second document begins here
    ---
    ^ a manifest is a single one
)");
}

TEST_F(ManifestSyntax, StrayComma) {
  EXPECT_EQ(messages("shoal: 1\n, output: out\n"),
            R"(m.yaml:2:1: error: this does not belong to the mapping above it
    , output: out
    ^ check the indentation
)");
}

TEST_F(ManifestSyntax, ListBehindMapping) {
  touch({"a.hdr"});
  EXPECT_EQ(messages("- file: a.hdr\nshoal: 1\n"),
            R"(m.yaml:2:1: error: this does not belong to what stands above it
    shoal: 1
    ^ check the indentation
)");
}

TEST_F(ManifestSyntax, ColonInValue) {
  EXPECT_EQ(messages("shoal: 1\noutput: a: b\n"),
            R"(m.yaml:2:10: error: a ":" where no key can stand
    output: a: b
             ^ check the indentation, and put values that hold ": " in quotes
)");
}

TEST_F(ManifestSyntax, Version) {
  EXPECT_EQ(messages("shoal: 2\nsomething: new\n"),
            R"(m.yaml:1:8: error: this shoal reads manifests of version 1, not "2"
    shoal: 2
           ^ a newer shoal may read it
)");
}

TEST_F(ManifestSyntax, NoVersion) {
  touch({"a.hdr"});
  EXPECT_EQ(messages("panoramas: [{file: a.hdr}]\n"),
            R"(m.yaml:1:1: error: this manifest does not say its version
    panoramas: [{file: a.hdr}]
    ^ begin it with "shoal: 1"
)");
}

TEST_F(ManifestSyntax, NoPanoramas) {
  EXPECT_EQ(messages("shoal: 1\noutput: out\n"),
            R"(m.yaml: error: the manifest names no panoramas
    add panoramas: with a list of entries such as - files: "*.hdr"
)");
}

TEST_F(ManifestSyntax, KeyWithoutBlank) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas: [{file: a.hdr}]
output:there
)"),
            R"(m.yaml:3:1: error: unknown key "output:there" in the manifest's top level
    output:there
    ^ put a blank after the colon
)");
}

TEST_F(ManifestSyntax, KeyGivenTwice) {
  touch({"a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
panoramas:
  - file: a.hdr
    degree: 2
    degree: 3
)"),
            R"(m.yaml:5:5: error: the key "degree" is given twice
        degree: 3
        ^ first on line 4
)");
}

TEST_F(ManifestSyntax, Variables) {
  touch({"lib/x.hdr", "a.hdr"});
  EXPECT_EQ(messages(R"(shoal: 1
vars: {library: lib, "a b": c, list: [1], self: "x${self}", one: "${two}", two: "${one}"}
panoramas:
  - files: "${libary}/*.hdr"
  - files: "${env:SHOAL_TEST_UNSET}/*.hdr"
  - files: "${library/*.hdr"
  - {file: a.hdr, layer: "${one}"}
)",
                     {.sets = {{"unused", "x"}}}),
            R"(m.yaml:2:22: error: "a b" cannot be a variable's name
    vars: {library: lib, "a b": c, list: [1], self: "x${self}", one: "${two}", two: "${one}"}
                         ^ use letters, digits, - and _
m.yaml:2:32: error: the variable "list" must be text or a number
    vars: {library: lib, "a b": c, list: [1], self: "x${self}", one: "${two}", two: "${one}"}
                                   ^
m.yaml:2:49: error: the variable "self" refers to itself
    vars: {library: lib, "a b": c, list: [1], self: "x${self}", one: "${two}", two: "${one}"}
                                                    ^
m.yaml:2:66: error: the variable "one" refers to itself
    vars: {library: lib, "a b": c, list: [1], self: "x${self}", one: "${two}", two: "${one}"}
                                                                     ^
m.yaml:2:81: error: the variable "two" refers to itself
    vars: {library: lib, "a b": c, list: [1], self: "x${self}", one: "${two}", two: "${one}"}
                                                                                    ^
m.yaml:4:13: error: no variable "libary"
      - files: "${libary}/*.hdr"
                ^ did you mean "library"?
m.yaml:5:13: error: no environment variable "SHOAL_TEST_UNSET"
      - files: "${env:SHOAL_TEST_UNSET}/*.hdr"
                ^ set it: SHOAL_TEST_UNSET=... shoal ...
m.yaml:6:13: error: "${" without its "}"
      - files: "${library/*.hdr"
                ^ write "$${" for the characters themselves
--set unused: error: the manifest knows no variable "unused"
)");
}

TEST_F(ManifestSyntax, Includes) {
  touch({"a.hdr"});
  write("b.yaml", "shoal: 1\ninclude: m.yaml\ndefaults: {degre: 1}\n");
  EXPECT_EQ(messages(R"(shoal: 1
include: [b.yaml, nowhere.yaml]
panoramas: [{file: a.hdr, degree: 99}]
)"),
            R"(m.yaml:2:19: error: nowhere.yaml: cannot be opened: No such file or directory
    include: [b.yaml, nowhere.yaml]
                      ^
m.yaml:3:35: error: degree must be a whole number from 0 to 64, not "99"
    panoramas: [{file: a.hdr, degree: 99}]
                                      ^
b.yaml:2:10: error: this manifest is included by itself
    include: m.yaml
             ^ m.yaml -> b.yaml -> m.yaml
b.yaml:3:12: error: unknown key "degre" in defaults
    defaults: {degre: 1}
               ^ did you mean "degree"?
)");
}

}  // namespace
}  // namespace shoal
