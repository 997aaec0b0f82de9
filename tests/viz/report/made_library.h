// A library that was never photographed: skies with a sun, each of its number alone.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "library/library.h"
#include "library/pixels.h"
#include "report/report.h"

namespace shoal::viz::test {

// `count` panoramas of degree `degree`, coefficients by summing over a 64x32 picture of the same
// light. Every fourth has a warning, the others have figures of quality that nobody measured; tags
// are "clear", "dim" and "red".
[[nodiscard]] Library made_library(std::size_t count, int degree);

// The picture behind made_library's panorama.
[[nodiscard]] Pixels made_pixels(std::size_t panorama, int width);

// made_pixels as a report asks for them.
class MadePictures {
 public:
  [[nodiscard]] PictureSource source();

 private:
  Pixels pixels_;
};

// There is none of any panorama, and this is why.
[[nodiscard]] PictureSource no_pictures(const std::string& why);

// Names that break pages which paste them.
[[nodiscard]] std::vector<std::string> hostile_names();

}  // namespace shoal::viz::test
