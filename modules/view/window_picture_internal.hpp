#pragma once
#include <string>

#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>

#include "view/vtk_messages_internal.hpp"

namespace insonify {

/// Writes what the window shows, which was drawn into its back buffer, as PNG: to a temporary name that is then renamed.
/// Throws Error(runtime) if VTK has complained, Error(file) if it cannot be made or written.
void save_window(vtkRenderWindow* window, const std::string& path, const VtkMessages& messages, const char* who);

/// The same of what `writer` was given.
void write_png(vtkPNGWriter* writer, const std::string& path, const VtkMessages& messages, const char* who);

}  // namespace insonify
