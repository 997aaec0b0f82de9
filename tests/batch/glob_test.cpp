#include "batch/glob.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "support/temporary_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class GlobTest : public ::testing::Test {
 protected:
  void touch(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      std::filesystem::create_directories((folder_ / name).parent_path());
      std::ofstream(folder_ / name).put('x');
    }
  }

  std::vector<std::string> expand(const std::string& pattern) {
    const Result<Glob> glob = Glob::parse(pattern);
    return glob ? glob->expand(folder_.path()).paths : std::vector{glob.error().text()};
  }

  test::TemporaryFolder folder_;
};

bool matches(const std::string& pattern, const std::string& path) {
  const Result<Glob> glob = Glob::parse(pattern);
  EXPECT_TRUE(glob.ok()) << pattern;
  return glob.ok() && glob->matches(path);
}

TEST(GlobMatch, Wildcards) {
  struct Case {
    std::string pattern, path;
    bool matches;
  };
  const Case cases[] = {
      {"*.hdr", "a.hdr", true},
      {"*.hdr", ".hdr", false},  // a dot in front wants to be spelt
      {".*.hdr", ".a.hdr", true},
      {"*.hdr", "a/b.hdr", false},
      {"a?.hdr", "ab.hdr", true},
      {"a?.hdr", "a.hdr", false},
      {"caf?.hdr", "caf\u00e9.hdr", true},  // one character, two bytes
      {"[ab].hdr", "b.hdr", true},
      {"[!ab].hdr", "b.hdr", false},
      {"[a-c]1.hdr", "b1.hdr", true},
      {"[]]", "]", true},
      {"\\[a].hdr", "[a].hdr", true},
      {"\\*.hdr", "a.hdr", false},
      {"**/a.hdr", "a.hdr", true},
      {"**/a.hdr", "x/y/a.hdr", true},
      {"x/**/a.hdr", "x/a.hdr", true},
      {"x/**/a.hdr", "y/a.hdr", false},
      {"x/**", "x/y/a.hdr", true},
      {"x/**", "x", false},
      {"**/a/**/b", "a/c/a/b", true},
      {"**/*", ".hidden/a", false},
      {"a**.hdr", "abc.hdr", true},  // not alone between slashes: two stars are one
      {"{a,b}.{hdr,exr}", "b.exr", true},
      {"{a,b}.{hdr,exr}", "c.exr", false},
      {"{a/b,c}/*.hdr", "a/b/x.hdr", true},
      {"{a,b{1,2}}.hdr", "b2.hdr", true},
      {"a{,_hdr}.exr", "a.exr", true},
      {"[{]a", "{a", true},  // no brace within brackets
      {"./a//b.hdr", "./a//b.hdr", true},
  };
  for (const Case& one : cases) {
    EXPECT_EQ(matches(one.pattern, one.path), one.matches) << one.pattern << " on " << one.path;
  }
}

TEST(GlobMatch, WithoutSlashAnyPartIsEnough) {
  const Result<Glob> thumbs = Glob::parse("*_thumb*");
  EXPECT_TRUE(thumbs->selects("x/a_thumb.hdr"));
  EXPECT_TRUE(thumbs->selects("all_thumbs/a.hdr"));
  EXPECT_FALSE(thumbs->selects("x/a.hdr"));
  EXPECT_FALSE(Glob::parse("x/*_thumb*")->selects("y/x/a_thumb.hdr"));
}

TEST(GlobParse, FixedPart) {
  EXPECT_EQ(Glob::parse("/data/hdri/**/*.hdr")->fixed_part(), "/data/hdri/");
  EXPECT_EQ(Glob::parse("/data/hd{ri,r}/x.hdr")->fixed_part(), "/data/");
  EXPECT_EQ(Glob::parse("a/b.hdr")->fixed_part(), "a/");
  EXPECT_EQ(Glob::parse("*.hdr")->fixed_part(), "");
  EXPECT_EQ(Glob::parse("hdri \\[2024\\]/*.hdr")->fixed_part(), "hdri [2024]/");
}

TEST(GlobParse, Mistakes) {
  EXPECT_EQ(Glob::parse("").error().what, "the pattern is empty");
  EXPECT_EQ(Glob::parse("a[b/c").error().what, "a [ has no closing ]");
  EXPECT_EQ(Glob::parse("a{b,c").error().what, "a { has no closing }");
  EXPECT_EQ(Glob::parse("*/../a").error().what, "\"..\" cannot follow a wildcard");
  std::string many = "x";
  for (int i = 0; i < 20; ++i) many += "{a,b}";  // 2^20 combinations
  EXPECT_EQ(Glob::parse(many).error().what, "the braces stand for more than 1000 patterns");
}

TEST_F(GlobTest, SortedBytewise) {
  touch({"b.hdr", "a/z.hdr", "a.hdr", "B.hdr", "a-b.hdr", "\u00e4.hdr", "c.txt"});
  // '-' < '.' < '/' < letters, capitals first, bytes above ASCII last.
  EXPECT_THAT(expand("**/*.hdr"),
              ElementsAre("B.hdr", "a-b.hdr", "a.hdr", "a/z.hdr", "b.hdr", "\u00e4.hdr"));
}

TEST_F(GlobTest, BelowTheFixedPart) {
  touch({"lib/x/a.hdr", "lib/b.exr", "other/c.hdr"});
  EXPECT_THAT(expand("lib/**/*.{hdr,exr}"), ElementsAre("b.exr", "x/a.hdr"));
  EXPECT_THAT(expand("./lib/../lib/*.exr"), ElementsAre("b.exr"));
  EXPECT_THAT(expand((folder_ / "lib").string() + "/*/*"), ElementsAre("x/a.hdr"));
  EXPECT_THAT(expand("lib/b.exr"), ElementsAre("b.exr"));
  EXPECT_THAT(expand("lib"), IsEmpty());
  EXPECT_THAT(expand("lib/"), IsEmpty());
}

TEST_F(GlobTest, OverlappingBracesGiveAFileOnce) {
  touch({"a/x.hdr", "b/x.hdr"});
  EXPECT_THAT(expand("{a,*}/{x,?}.hdr"), ElementsAre("a/x.hdr", "b/x.hdr"));
}

TEST_F(GlobTest, LinksNeitherLoopNorHide) {
  touch({"lib/a.hdr", "real/b.hdr"});
  namespace fs = std::filesystem;
  fs::create_directory_symlink("..", folder_ / "lib/up");
  fs::create_directory_symlink("../real", folder_ / "lib/link");
  fs::create_symlink("../real/b.hdr", folder_ / "lib/c.hdr");
  fs::create_symlink("nowhere.hdr", folder_ / "lib/dangling.hdr");
  fs::create_symlink("self.hdr", folder_ / "lib/self.hdr");
  EXPECT_THAT(expand("lib/**/*.hdr"), ElementsAre("a.hdr", "c.hdr", "dangling.hdr", "self.hdr"));
  EXPECT_THAT(expand("lib/link/**"), ElementsAre("b.hdr"));
  EXPECT_THAT(expand("lib/*/b.hdr"), ElementsAre("link/b.hdr"));
}

TEST_F(GlobTest, PipesAreNoPictures) {
  touch({"a.hdr"});
  ASSERT_EQ(::mkfifo((folder_ / "pipe.hdr").c_str(), 0600), 0);
  EXPECT_THAT(expand("*.hdr"), ElementsAre("a.hdr"));
  EXPECT_THAT(expand("pipe.hdr"), IsEmpty());
}

TEST_F(GlobTest, UnreadableFoldersAreTold) {
  touch({"a.hdr", "locked/b.hdr"});
  const GlobMatches missing = Glob::parse("nowhere/*.hdr")->expand(folder_.path());
  ASSERT_EQ(missing.unreadable.size(), 1u);
  EXPECT_EQ(missing.unreadable[0].reason, "No such file or directory");
  if (::geteuid() == 0) GTEST_SKIP() << "root may read every folder";
  namespace fs = std::filesystem;
  fs::permissions(folder_ / "locked", fs::perms::none);
  const GlobMatches locked = Glob::parse("**/*.hdr")->expand(folder_.path());
  fs::permissions(folder_ / "locked", fs::perms::owner_all);
  EXPECT_THAT(locked.paths, ElementsAre("a.hdr"));
  ASSERT_EQ(locked.unreadable.size(), 1u);
  EXPECT_EQ(locked.unreadable[0].path, (folder_ / "locked/").string());
}

}  // namespace
}  // namespace shoal
