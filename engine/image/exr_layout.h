// Where the pixels of an EXR part lie in the picture, and how the picture is cut into bands.
//
// The picture is the display window (the data window of a lat-long environment map). Chunks are
// aligned to the top of the data window, so bands are too; rows of the picture outside of the data
// window are black and form bands of their own, above and below.
#pragma once

#include <cstdint>
#include <string>

#include "core/result.h"
#include "image/exr_part.h"
#include "image/exr_selection.h"

namespace shoal {

// Rows [row_begin, row_end) of the picture. They lie in the chunk rows (scanline chunks or rows of
// tiles, counted from the top of the data window) [chunk_begin, chunk_end); none: they are black.
struct ExrBand {
  int row_begin = 0;
  int row_end = 0;
  int chunk_begin = 0;
  int chunk_end = 0;

  [[nodiscard]] bool is_black() const { return chunk_begin == chunk_end; }
};

struct ExrLayout {
  int width = 0;  // of the picture
  int height = 0;

  // The data window in the picture's coordinates, which may reach outside of the picture.
  int data_x = 0;
  int data_y = 0;
  int data_width = 0;
  int data_height = 0;

  // What of the picture the data window covers; empty ranges when nothing.
  int visible_x_begin = 0;
  int visible_x_end = 0;
  int visible_y_begin = 0;
  int visible_y_end = 0;

  int chunk_rows = 1;
  int chunks_per_band = 1;
  int first_chunk = 0;  // the chunk row that holds row visible_y_begin
  int black_bands_above = 0;
  int data_bands = 0;
  int black_bands_below = 0;

  [[nodiscard]] int rows_per_band() const { return chunk_rows * chunks_per_band; }
  [[nodiscard]] int band_count() const {
    return black_bands_above + data_bands + black_bands_below;
  }
  // Precondition: 0 <= index < band_count().
  [[nodiscard]] ExrBand band(int index) const;

  // Every row of the data window reaches over the whole width of the picture.
  [[nodiscard]] bool covers_width() const { return data_x <= 0 && data_x + data_width >= width; }
  [[nodiscard]] double covered_fraction() const;

  // Tiles [begin, end) of a row of tiles that show in the picture. Precondition: some do.
  struct Columns {
    int begin = 0;
    int end = 0;
  };
  [[nodiscard]] Columns visible_tiles(int tile_width) const {
    return {(visible_x_begin - data_x) / tile_width, (visible_x_end - 1 - data_x) / tile_width + 1};
  }

  // Rows of chunk row `chunk`, and its first row in the picture's coordinates (may be negative).
  [[nodiscard]] int rows_of_chunk(int chunk) const;
  [[nodiscard]] int row_of_chunk(int chunk) const { return data_y + chunk * chunk_rows; }
};

// Lays the part out after checking its sizes against our limits and against the size of the file,
// so that nothing is allocated on the word of a hostile header. `rows_wanted`: as
// ReadOptions::rows_per_band. Errors: unsupported (too large), malformed (cannot be in this file).
Result<ExrLayout> lay_out_exr(const ExrContext& context, const ExrPart& part,
                              const ExrColour& colour, int rows_wanted);

}  // namespace shoal
