#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/contact_card.h"
#include "scenes/scene.h"
#include "viz/scenes/made_library.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

Library library_of(int count) {
  Library library;
  library.title = "many";
  for (int i = 0; i < count; ++i) {
    library.panoramas.push_back(
        test::panorama_of("panorama " + std::to_string(i),
                          test::light_from({1.0, 0.1 * i, 0.5}, {1.0, 1.0, 1.0}, 2)));
  }
  return library;
}

TEST(ContactPages, AreAsManyAsItTakes) {
  SceneSettings settings;  // 20 on a page
  EXPECT_EQ(contact_page_count(library_of(0), settings), 1);
  EXPECT_EQ(contact_page_count(library_of(1), settings), 1);
  EXPECT_EQ(contact_page_count(library_of(20), settings), 1);
  EXPECT_EQ(contact_page_count(library_of(21), settings), 2);
  settings.grid = Grid{1, 1};
  EXPECT_EQ(contact_page_count(library_of(7), settings), 7);
}

TEST(ContactPages, ThatAreNotThereAreAnError) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  const Library library = library_of(5);
  PixelCache pixels(library);
  SceneInput input{&library, 0, std::nullopt, {}, &pixels};
  input.settings.grid = Grid{2, 2};
  for (const int page : {0, 1}) {
    input.settings.page = page;
    EXPECT_TRUE(show_scene(SceneKind::contact, input, **window)) << page;
  }
  for (const int page : {-1, 2}) {
    input.settings.page = page;
    const Status status = show_scene(SceneKind::contact, input, **window);
    ASSERT_FALSE(status) << page;
    EXPECT_EQ(status.error().code, ErrorCode::usage);
  }
  EXPECT_EQ(show_scene(SceneKind::contact, input, **window).error().text(),
            "the contact sheet has no page 3 (it has 2 pages)");
}

bool apart(const Rectangle& a, const Rectangle& b) {
  constexpr double kSlack = 1e-9;
  return a.right <= b.left + kSlack || b.right <= a.left + kSlack || a.top <= b.bottom + kSlack ||
         b.top <= a.bottom + kSlack;
}

bool inside(const Rectangle& part, const Rectangle& whole) {
  constexpr double kSlack = 1e-9;
  return part.left >= whole.left - kSlack && part.right <= whole.right + kSlack &&
         part.bottom >= whole.bottom - kSlack && part.top <= whole.top + kSlack;
}

// Whatever the grid and the window, a card's parts lie in it and on none of the others, pictures
// have their shapes, and the words are whole lines high.
TEST(ContactCards, HoldTheirPartsApart) {
  auto window = make_offscreen_window({640, 360});
  if (!window) GTEST_SKIP() << window.error().text();
  for (const PictureSize size : {PictureSize{1280, 720}, {1920, 1080}, {800, 800}, {600, 900}}) {
    (*window)->SetSize(size.width, size.height);
    Stage stage(**window);
    stage.set_title("a title");
    stage.set_caption("a caption");
    for (const auto& [columns, rows] :
         {std::pair(1, 1), {5, 4}, {2, 6}, {6, 2}, {8, 8}, {10, 10}}) {
      const Rectangle cell = grid_cell(stage.body(), columns, rows, columns - 1, 0);
      const ContactCard card = lay_out_card(stage, cell);
      const Rectangle parts[] = {card.thumbnail, card.ball, card.lobe, card.words};
      for (const Rectangle& part : parts) {
        EXPECT_TRUE(inside(part, cell)) << columns << " of " << size.width;
        EXPECT_GT(part.height() * size.height, 8.0) << columns << " of " << size.width;
        for (const Rectangle& other : parts) {
          EXPECT_TRUE(&part == &other || apart(part, other)) << columns << " of " << size.width;
        }
      }
      EXPECT_NEAR(stage.aspect(card.thumbnail), 2.0, 1e-9);
      EXPECT_NEAR(stage.aspect(card.ball), 1.0, 1e-9);
      EXPECT_NEAR(stage.aspect(card.lobe), 1.0, 1e-9);
      EXPECT_NEAR(card.words.height(), card.lines * stage.line_height(TextSize::small), 1e-9);
    }
  }
}

// Of fewer panoramas the pictures are never smaller, and one has the page for itself. A whole page
// is no worse than five by four.
TEST(ContactGrids, GiveFewPanoramasMoreRoom) {
  auto window = make_offscreen_window({1280, 720});
  if (!window) GTEST_SKIP() << window.error().text();
  for (const PictureSize size : {PictureSize{1280, 720}, {400, 800}, {1920, 400}}) {
    (*window)->SetSize(size.width, size.height);
    const Stage stage(**window);
    const auto size_in = [&](const Grid& grid) {
      const ContactCard card =
          lay_out_card(stage, grid_cell(stage.body(), grid.columns, grid.rows, 0, 0));
      return card.thumbnail.width() * card.thumbnail.height() +
             2.0 * card.ball.width() * card.ball.height();
    };
    double last = 1.0;
    for (int count = 1; count <= kCellsOfPage; ++count) {
      const Grid grid = roomiest_grid(stage, stage.body(), count);
      EXPECT_GE(grid.columns * grid.rows, count);
      EXPECT_LT(grid.columns * (grid.rows - 1), count) << "a row is empty";
      EXPECT_LE(size_in(grid), last * (1.0 + 1e-9)) << count << " on " << size.width;
      last = size_in(grid);
    }
    EXPECT_GE(last, size_in({5, 4}));
    EXPECT_EQ(roomiest_grid(stage, stage.body(), 1).columns, 1);
  }
}

// A hundred on a page of 1280 x 720: the pictures are still twenty pixels high.
TEST(ContactCards, AreReadableByTheHundred) {
  auto window = make_offscreen_window({1280, 720});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  stage.set_title("a title");
  const std::string lines[] = {"a caption", "of two lines"};
  stage.set_caption(lines);
  const ContactCard card = lay_out_card(stage, grid_cell(stage.body(), 10, 10, 0, 0));
  EXPECT_GE(card.ball.height() * 720, 20.0);
  EXPECT_GE(card.words.width() * 1280, 90.0);
}

}  // namespace
}  // namespace shoal::viz
