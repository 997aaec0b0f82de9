// The scenes one by one; show_scene picks.
#pragma once

#include "core/result.h"
#include "scenes/scene.h"
#include "scenes/stage.h"

namespace shoal::viz {

[[nodiscard]] Status show_basis_scene(const SceneInput& input, Stage& stage);
[[nodiscard]] Status show_lobes_scene(const SceneInput& input, Stage& stage);
[[nodiscard]] Status show_sphere_scene(const SceneInput& input, Stage& stage);
[[nodiscard]] Status show_degrees_scene(const SceneInput& input, Stage& stage);
[[nodiscard]] Status show_lit_scene(const SceneInput& input, Stage& stage);
[[nodiscard]] Status show_compare_scene(const SceneInput& input, Stage& stage);
[[nodiscard]] Status show_contact_scene(const SceneInput& input, Stage& stage);

// What the scenes share: the panorama that is shown, its light and names.

// The panorama of `input`. Precondition: the library has one at `current`.
[[nodiscard]] const Panorama& current_panorama(const SceneInput& input);

// "name" or "name (variant)"; something also where the name is empty.
[[nodiscard]] std::string title_of(const Panorama& panorama);

// Whose the pixels are: of its file or painted, changed as its light is; or, where nobody can tell
// how that was made of them, those that it began with.
[[nodiscard]] std::string describe_pixels(const Panorama& panorama);

// Whether these pixels, asked for at most `asked` wide, are the texels of its file one by one.
[[nodiscard]] bool are_its_texels(const Panorama& panorama, const Pixels& pixels, int asked);

// The coefficients of the settings' quantity to the settings' degree, in the settings' frame.
[[nodiscard]] Coefficients shown_coefficients(const Panorama& panorama,
                                              const SceneSettings& settings);

[[nodiscard]] std::string_view name_of(Channel channel);

// "radiance" or "irradiance", for captions, with the unit's convention where it matters.
[[nodiscard]] std::string describe(Quantity quantity);

}  // namespace shoal::viz
