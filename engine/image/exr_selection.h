// Which part of an EXR file is the picture, and which of its channels are its colour.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/row_band.h"
#include "image/exr_part.h"
#include "image/panorama_source.h"

namespace shoal {

enum class ExrColourModel {
  rgb,               // channels R, G, B
  grey,              // channel Y alone
  luminance_chroma,  // channels Y, RY, BY, the latter two at half resolution
};

struct ExrColour {
  ExrColourModel model = ExrColourModel::rgb;
  // Indices into ExrPart::channels: R, G, B; or Y; or Y, RY, BY.
  std::array<int, kMaxChannels> channels{};

  // Of the bands that come out: luminance/chroma is turned to RGB in reading.
  [[nodiscard]] int channel_count() const { return model == ExrColourModel::grey ? 1 : 3; }
};

struct ExrSelection {
  int part = 0;
  ExrColour colour;
};

// Chooses by options.part and options.layer. Without a part: the first one with R, G, B (or Y, RY,
// BY) that is a panorama, then the first grey one.
// Errors: usage (no such part or layer), unsupported (no colour, deep, subsampled R, G, B).
Result<ExrSelection> select_exr_colour(const std::vector<ExrPart>& parts,
                                       const ReadOptions& options, const std::string& path);

}  // namespace shoal
