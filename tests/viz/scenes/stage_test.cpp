#include "scenes/stage.h"

#include <gtest/gtest.h>

#include <vtkNew.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "scenes/legends.h"
#include "scenes/type.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

std::array<int, 3> pixel(const Picture& picture, double x, double y) {
  const int column = static_cast<int>(x * picture.size.width);
  const int row = static_cast<int>((1.0 - y) * picture.size.height);
  const unsigned char* p = picture.rgb.data() + 3 * (row * picture.size.width + column);
  return {p[0], p[1], p[2]};
}

TEST(Layout, CellsTileTheirAreaTheTopRowFirst) {
  const Rectangle area{0.1, 0.2, 0.9, 0.8};
  const Rectangle first = grid_cell(area, 4, 3, 0, 0);
  const Rectangle last = grid_cell(area, 4, 3, 3, 2);
  EXPECT_DOUBLE_EQ(first.left, 0.1);
  EXPECT_DOUBLE_EQ(first.top, 0.8);
  EXPECT_DOUBLE_EQ(last.right, 0.9);
  EXPECT_NEAR(last.bottom, 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(grid_cell(area, 4, 3, 1, 1).left, grid_cell(area, 4, 3, 0, 1).right);
}

TEST(Ticks, AreRoundInsideAndAscending) {
  for (const auto& [low, high] :
       {std::pair(0.0, 1.0), {-3.0, 3.0}, {0.0012, 0.0019}, {-1e5, 7e5}, {17.0, 18.5}}) {
    for (const int count : {2, 5, 7}) {
      const auto ticks = ticks_between(low, high, count);
      ASSERT_GE(ticks.size(), 2u);
      EXPECT_LE(ticks.size(), static_cast<std::size_t>(count) + 2);
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_GE(ticks[i].value, low - 1e-9 * (high - low));
        EXPECT_LE(ticks[i].value, high + 1e-9 * (high - low));
        if (i == 0) continue;
        EXPECT_GT(ticks[i].value, ticks[i - 1].value);
        EXPECT_NE(ticks[i].text, ticks[i - 1].text);
      }
    }
  }
  EXPECT_TRUE(ticks_between(1.0, 1.0, 5).empty());
}

TEST(Numbers, HaveThreeDigits) {
  EXPECT_EQ(text_of(0.0), "0");
  EXPECT_EQ(text_of(3.14159), "3.14");
  EXPECT_EQ(text_of(-2.5), std::string(kMinus) + "2.5");
  EXPECT_EQ(text_of(1234.5), "1234");
  EXPECT_EQ(text_of(2.5e-6), "2.5e-06");
}

TEST(Numbers, OfSharesArePercent) { EXPECT_EQ(percent_of(0.125), "12.5 %"); }

// A heading has half a line above it, but at the top.
TEST(Figures, TakeTheHeightThatIsTold) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  const FigureRow rows[] = {{"heading", ""}, {"name", "1"}, {"another", ""}, {"name", "2"}};
  const double below = add_figures(stage, {0.1, 0.1, 0.5, 0.9}, rows);
  EXPECT_NEAR(0.9 - below, figures_height(stage, rows), 1e-12);
}

TEST(Stage, TypeGrowsWithTheWindowAndStaysLegible) {
  auto window = make_offscreen_window({1280, 720});
  if (!window) GTEST_SKIP() << window.error().text();
  const Stage stage(**window);
  EXPECT_EQ(stage.text_pixels(TextSize::small), 14);
  EXPECT_EQ(stage.text_pixels(TextSize::title), 26);
  (*window)->SetSize(320, 180);
  EXPECT_EQ(Stage(**window).text_pixels(TextSize::small), 11);
  (*window)->SetSize(1920, 1080);
  EXPECT_EQ(Stage(**window).text_pixels(TextSize::small), 21);
  (*window)->SetSize(480, 1080);  // half as wide as 4:3 of 720 lines
  EXPECT_EQ(Stage(**window).text_pixels(TextSize::title), 13);
}

TEST(Stage, TitleAndCaptionLeaveTheBodyFree) {
  auto window = make_offscreen_window({1280, 720});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  const Rectangle before = stage.body();
  stage.set_title("A title", "and what it is about");
  stage.set_caption("a caption");
  EXPECT_LT(stage.body().top, before.top - 0.03);
  EXPECT_GT(stage.body().bottom, before.bottom + 0.02);
  const Picture picture = take_picture(**window);
  const std::array<int, 3> background = pixel(picture, 0.001, 0.5);
  for (int row = 0; row < 720; ++row) {
    const double y = 1.0 - (row + 0.5) / 720;
    if (y >= stage.body().top || y <= stage.body().bottom) continue;
    for (int column = 0; column < 1280; ++column) {
      ASSERT_EQ(pixel(picture, (column + 0.5) / 1280, y), background) << column << ' ' << row;
    }
  }
}

TEST(Stage, KeepsTheClausesThatHaveRoom) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  const Stage stage(**window);
  const auto within = [&](const std::string& text, const std::string& as_wide_as) {
    return stage.clauses_within(text, TextSize::label,
                                stage.text_width(as_wide_as, TextSize::label));
  };
  EXPECT_EQ(within("one; two; three", "one; two; three"), "one; two; three");
  EXPECT_EQ(within("one; two; three", "one; two; thr"), "one; two");
  EXPECT_EQ(within("one; two; three", "one; tw"), "one");
  EXPECT_EQ(within("one; two; three", "o"), "one");
}

// Names lose their middle, evenly; a variant, with what follows it, stays whole while it has room.
TEST(Shortened, KeepsWhatTellsNamesApart) {
  vtkNew<vtkTextProperty> property;
  set_font(*property, "");
  property->SetFontSize(16);
  const auto within = [&](const std::string& text, const std::string& as_wide_as, TextCut cut) {
    return shortened(text, *property, measured_width(as_wide_as, *property), cut);
  };
  const std::string name = "aaaaaaaaaabbbbbbbbbb";
  EXPECT_EQ(within(name, name, TextCut::middle), name);
  EXPECT_EQ(within(name, "aaaaa...bbbbb", TextCut::middle), "aaaaa...bbbbb");
  EXPECT_EQ(within(name, "aaaaa...", TextCut::end), "aaaaa...");
  const std::string variant = name + " (soft), degree 2";
  EXPECT_EQ(within(variant, "aaa... (soft), degree 2", TextCut::middle), "aaa... (soft), degree 2");
  const std::string narrow = within(variant, "aaa... 2", TextCut::middle);
  EXPECT_EQ(narrow.find("(soft)"), std::string::npos);
  EXPECT_TRUE(narrow.starts_with("a") && narrow.ends_with(" 2")) << narrow;
  // A letter of two bytes goes as a whole.
  EXPECT_EQ(within("\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4", "\u00e4...\u00e4", TextCut::middle),
            "\u00e4...\u00e4");
}

// Nothing is left out: a letter that the font lacks has a sign in its place, and those that it has
// stay, marks on others and what nobody sees included. No font has U+10FFFD, for private use; VTK's
// has no box.
TEST(Drawable, HasASignForEveryLetterThatIsNotThere) {
  const auto drawn = [](const std::string& text) {
    vtkNew<vtkTextProperty> property;
    set_font(*property, text);
    property->SetFontSize(11);
    return drawable(text, *property);
  };
  for (const char* text : {"", "plain (soft)", "Z\u00fcrich", "11.4 \u00b7 59 %, \u22123\u00b0",
                           "l \u2264 4", "a\u00a0b\u200bc\ufe0f"}) {
    EXPECT_EQ(drawn(text), text);
  }
  EXPECT_EQ(drawn("a\xff z\xc3"), "a? z?");
  const std::string mixed = drawn("e\u0301 \u0391\U0010fffd.\u0391");
  if (mixed.find("\u0391") == std::string::npos) GTEST_SKIP() << "no font has Greek letters";
  EXPECT_EQ(mixed, "e\u0301 \u0391\u25a1.\u0391");
}

// Where no font has East Asian letters each is a box, which takes room.
TEST(Stage, ShowsThatLettersAreMissing) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  const double one = stage.text_width("Z\u00fcrich \u2600 \u6771", TextSize::label);
  const double two = stage.text_width("Z\u00fcrich \u2600 \u6771\u4eac", TextSize::label);
  EXPECT_GT(two - one, 0.5 * stage.text_pixels(TextSize::label) / 640);
  stage.add_text(0.1, 0.5, "\u6771\u4eac");
  const Picture picture = take_picture(**window);
  const std::array<int, 3> background = pixel(picture, 0.001, 0.1);
  int drawn = 0;
  for (int column = 0; column < 640; ++column) {
    drawn += pixel(picture, (column + 0.5) / 640, 0.51) != background;
  }
  EXPECT_GE(drawn, 2);
}

// A clause that is longer than a line goes on in another, after a word.
TEST(Stage, CaptionsGoOnAfterAWord) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  const Stage stage(**window);
  const double width = stage.text_width("two words of", TextSize::label);
  const std::vector<std::string> lines = stage.wrapped("two words of it", TextSize::label, width);
  EXPECT_EQ(lines, (std::vector<std::string>{"two words of", "it"}));
  EXPECT_EQ(stage.wrapped("longerthanaline", TextSize::label, 0.01).size(), 1U);
}

// A caption too long for its width goes on in another line, which the body makes room for.
TEST(Stage, CaptionsGoOnInAnotherLine) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage one(**window);
  const double width = 1.5 * one.text_width("a clause; another", TextSize::label);
  one.set_caption("a clause; another", width);
  Stage two(**window);
  two.set_caption("a clause; another; a third; a fourth", width);
  EXPECT_NEAR(two.body().bottom - one.body().bottom, two.line_height(TextSize::label), 1e-12);
}

// The square's outline, a pixel thick, around the place, or inside where that is at the edge.
TEST(Marks, StandAroundTheirPlaceAndInside) {
  auto window = make_offscreen_window({200, 100});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  const Rectangle area{0.1, 0.2, 0.9, 0.8};  // 160 x 60 pixels from (20, 20)
  add_mark(stage, area, {0.25, 0.5}, 0.1, {1.0f, 0.0f, 0.0f});
  add_mark(stage, area, {1.0, 0.0}, 0.1, {0.0f, 1.0f, 0.0f});
  const Picture picture = take_picture(**window);
  // Around pixel (60, 50) reaching 10 to all sides, and the last 20 of the upper right corner.
  const std::array red{255, 0, 0};
  const std::array green{0, 255, 0};
  EXPECT_EQ(pixel(picture, 50.5 / 200, 0.5), red);
  EXPECT_EQ(pixel(picture, 69.5 / 200, 0.5), red);
  EXPECT_EQ(pixel(picture, 0.3, 0.405), red);
  EXPECT_EQ(pixel(picture, 0.3, 0.595), red);
  EXPECT_NE(pixel(picture, 0.3, 0.5), red);
  EXPECT_EQ(pixel(picture, 160.5 / 200, 0.7), green);
  EXPECT_EQ(pixel(picture, 179.5 / 200, 0.7), green);
  EXPECT_NE(pixel(picture, 181.0 / 200, 0.7), green);
}

// What is added later lies on top, and the flat picture of four colours stands as it was made.
TEST(Stage, FlatThingsLieInTheirOrder) {
  auto window = make_offscreen_window({200, 100});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  stage.add_box({0.1, 0.1, 0.5, 0.9}, {1.0f, 0.0f, 0.0f});
  stage.add_box({0.3, 0.1, 0.5, 0.9}, {0.0f, 1.0f, 0.0f});
  const Picture corners{{2, 2}, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
  stage.add_picture({0.6, 0.2, 0.9, 0.8}, corners);
  const Picture picture = take_picture(**window);
  EXPECT_EQ(pixel(picture, 0.2, 0.5), (std::array{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 0.4, 0.5), (std::array{0, 255, 0}));
  EXPECT_EQ(pixel(picture, 0.62, 0.77), (std::array{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 0.88, 0.77), (std::array{0, 255, 0}));
  EXPECT_EQ(pixel(picture, 0.62, 0.23), (std::array{0, 0, 255}));
  EXPECT_EQ(pixel(picture, 0.88, 0.23), (std::array{255, 255, 255}));
}

TEST(Stage, ShortensWhatIsTooLong) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  EXPECT_GT(stage.text_width("wide words", TextSize::label), 0.05);
  EXPECT_GT(stage.text_width("wide words", TextSize::title),
            stage.text_width("wide words", TextSize::label));
  stage.add_text(0.1, 0.5, std::string(300, 'w'), {.max_width = 0.3});
  const Picture picture = take_picture(**window);
  const std::array<int, 3> background = pixel(picture, 0.001, 0.1);
  bool something = false;
  for (int column = 0; column < 640; ++column) {
    for (int row = 0; row < 360; ++row) {
      const double x = (column + 0.5) / 640;
      const bool drawn = pixel(picture, x, 1.0 - (row + 0.5) / 360) != background;
      something |= drawn;
      if (x < 0.099 || x > 0.41) {
        ASSERT_FALSE(drawn) << column << ' ' << row;
      }
    }
  }
  EXPECT_TRUE(something);
}

}  // namespace
}  // namespace shoal::viz
