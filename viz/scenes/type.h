// Type: fonts, and how much room words take.
#pragma once

#include <vtkTextProperty.h>

#include <string>

namespace shoal::viz {

// The font that VTK carries with it, so that words look the same everywhere; it has Latin letters
// and a few signs of mathematics. For text beyond them a font of the system, where there is one.
void set_font(vtkTextProperty& property, const std::string& text);

// The text as the property's font can draw it: VTK leaves out letters that the font lacks, so each
// of them is a box here, or a question mark where the font has no box.
[[nodiscard]] std::string drawable(const std::string& text, vtkTextProperty& property);

// Pixels that a line of type takes.
[[nodiscard]] double measured_width(const std::string& text, vtkTextProperty& property);

// What a text that is too long loses: its end, or, of names, which are told apart by their ends,
// its middle. A last "(variant)" with what follows it stays whole where it has room.
enum class TextCut { end, middle };

// The text, or as much of it, with three dots, as stays within so many pixels.
[[nodiscard]] std::string shortened(const std::string& text, vtkTextProperty& property,
                                    double pixels, TextCut cut);

}  // namespace shoal::viz
