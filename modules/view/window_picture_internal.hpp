#pragma once
#include <string>

#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>

#include "view/vtk_messages_internal.hpp"

namespace insonify {

/// Writes the window's back buffer as PNG, to a temporary name that is then renamed. Throws Error(runtime) if VTK
/// reported an error, Error(file) if the file cannot be written.
void save_window(vtkRenderWindow* window, const std::string& path, const VtkMessages& messages, const char* who);

/// The same for the input of `writer`.
void write_png(vtkPNGWriter* writer, const std::string& path, const VtkMessages& messages, const char* who);

}  // namespace insonify
