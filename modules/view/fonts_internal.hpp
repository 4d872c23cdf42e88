#pragma once
#include <string>

#include <vtkTextProperty.h>

namespace insonify {

/// Gives the property the product's font: DejaVu Sans where it is found, else a font near to it, else the one
/// that VTK has built in (which lacks Greek: see readable_text).
void set_font(vtkTextProperty* property, int font_size);

/// The text itself, or, if only VTK's built-in font is there, the text with µ written as u.
std::string readable_text(const std::string& text);

}  // namespace insonify
