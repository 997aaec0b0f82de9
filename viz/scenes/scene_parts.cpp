#include "scenes/scene_parts.h"

#include "sphere/linear_operations.h"

namespace shoal::viz {

const Panorama& current_panorama(const SceneInput& input) {
  return input.library->panoramas[input.current];
}

std::string title_of(const Panorama& panorama) {
  const std::string& name = panorama.name.empty() ? "(no name)" : panorama.name;
  return panorama.variant.empty() ? name : name + " (" + panorama.variant + ")";
}

std::string describe_pixels(const Panorama& panorama) {
  if (!panorama.change.is_whole) return "its pixels; light was added or taken out";
  const bool painted = panorama.file.empty();
  const bool same = panorama.change == LightChange{};
  return (painted ? "painted anew" : "its pixels") +
         std::string(same ? "" : ", changed as its light is");
}

bool are_its_texels(const Panorama& panorama, const Pixels& pixels, int asked) {
  if (panorama.file.empty()) return false;
  const bool is_known = panorama.pixels.has_value();
  return pixels.width < asked || (is_known && panorama.pixels->width == pixels.width);
}

Coefficients shown_coefficients(const Panorama& panorama, const SceneSettings& settings) {
  Coefficients coefficients = apply_quantity(radiance_of(panorama), settings.quantity);
  if (settings.degree) coefficients = truncate(std::move(coefficients), *settings.degree);
  return to_frame(coefficients, settings.frame);
}

std::string_view name_of(Channel channel) {
  switch (channel) {
    case Channel::red:
      return "red";
    case Channel::green:
      return "green";
    case Channel::blue:
      return "blue";
    case Channel::luminance:
      break;
  }
  return "luminance";
}

std::string describe(Quantity quantity) {
  return quantity == Quantity::irradiance_over_pi ? "irradiance / pi"
                                                  : std::string(name_of(quantity));
}

}  // namespace shoal::viz
