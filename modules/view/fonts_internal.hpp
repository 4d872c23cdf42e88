#pragma once
#include <string>

#include <vtkTextProperty.h>

namespace insonify {

/// Sets the font: DejaVu Sans if installed, else a similar one, else VTK's built-in font (which lacks Greek: see
/// readable_text).
void set_font(vtkTextProperty* property, int font_size);

/// The text, with µ written as u if only VTK's built-in font is available.
std::string readable_text(const std::string& text);

}  // namespace insonify
