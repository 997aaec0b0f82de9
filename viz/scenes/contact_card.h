// Where things stand on a card of the contact sheet.
#pragma once

#include "scenes/scene.h"
#include "scenes/stage.h"

namespace shoal::viz {

struct ContactCard {
  Rectangle thumbnail;  // twice as wide as high
  Rectangle ball;       // a square
  Rectangle lobe;       // a square
  Rectangle words;
  int lines = 2;  // of words
};

// Of two ways the one with the larger pictures: the thumbnail over the words, two lines or where
// there is room three, ball and lobe above one another beside them; or the three pictures in a row
// over the words, which are one line where two would take half of the card.
[[nodiscard]] ContactCard lay_out_card(const Stage& stage, const Rectangle& cell);

// The grid of at least `count` cells over the area whose cards have the largest pictures; of equal
// ones that with the fewest cells. Precondition: count >= 1.
[[nodiscard]] Grid roomiest_grid(const Stage& stage, const Rectangle& area, int count);

}  // namespace shoal::viz
