// Type: fonts, and how much room words take.
#pragma once

#include <vtkTextProperty.h>

#include <string>

namespace shoal::viz {

// The font that VTK carries with it, so that words look the same everywhere; it has Latin letters
// and a few signs of mathematics. For text beyond them a font of the system, where there is one.
void set_font(vtkTextProperty& property, const std::string& text);

// Pixels that a line of type takes.
[[nodiscard]] double measured_width(const std::string& text, vtkTextProperty& property);

// The text, or as much of its beginning, with three dots, as stays within so many pixels.
[[nodiscard]] std::string shortened(const std::string& text, vtkTextProperty& property,
                                    double pixels);

}  // namespace shoal::viz
