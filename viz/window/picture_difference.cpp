#include "window/picture_difference.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace shoal::viz {
namespace {

std::string text_of(const PictureSize& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

Result<PictureDifference> compare_pictures(const Picture& a, const Picture& b, int threshold) {
  if (a.size != b.size) {
    return Error{ErrorCode::usage,
                 "one picture is " + text_of(a.size) + ", the other " + text_of(b.size), "",
                 "compare pictures of one size"};
  }
  PictureDifference difference;
  std::int64_t sum = 0;
  std::int64_t above = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    int pixel = 0;
    for (std::size_t c = i; c < i + 3; ++c) pixel = std::max(pixel, std::abs(a.rgb[c] - b.rgb[c]));
    difference.largest = std::max(difference.largest, pixel);
    sum += pixel;
    above += pixel > threshold;
  }
  const double pixel_count = std::max(1.0, static_cast<double>(a.rgb.size() / 3));
  difference.mean = static_cast<double>(sum) / pixel_count;
  difference.share = static_cast<double>(above) / pixel_count;
  return difference;
}

Picture difference_picture(const Picture& a, const Picture& b) {
  Picture picture{a.size, std::vector<unsigned char>(a.rgb.size())};
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    picture.rgb[i] = static_cast<unsigned char>(std::min(255, 8 * std::abs(a.rgb[i] - b.rgb[i])));
  }
  return picture;
}

}  // namespace shoal::viz
