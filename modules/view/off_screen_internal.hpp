// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include <EGL/egl.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOutputWindow.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include "core/library_turn.hpp"

namespace insonify {

/// A VTK render window without a screen: surfaceless EGL (Mesa), which needs neither an X server nor DISPLAY.
/// Debian's VTK 9.1 supports only X windows and aborts the program if there is no display.
class EglWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static EglWindow* New();
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow);

  /// Creates the GL context. Throws Error(runtime) with the remedy if that fails.
  void open(const char* who);

  void MakeCurrent() override;
  bool IsCurrent() override;
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }
  void OpenGLInitContext() override;

 protected:
  EglWindow();
  ~EglWindow() override;

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLSurface surface_ = EGL_NO_SURFACE;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// Collects VTK's error output during its lifetime, and holds the turn to draw.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// Throws Error(runtime) with VTK's first error, if it reported any. Warnings are dropped.
  void throw_first_error(const char* who) const;

 private:
  VtkTurn turn_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkSmartPointer<vtkOutputWindow> collector_;
};

/// Returns the window's back buffer as the bytes of a PNG. Throws Error(runtime) if VTK reported an error.
std::string png_of_window(vtkRenderWindow* window, const VtkMessages& messages, const char* who);

/// Returns the input of `writer` as the bytes of a PNG. Throws Error(runtime) if VTK reported an error.
std::string bytes_of_png(vtkPNGWriter* writer, const VtkMessages& messages, const char* who);

/// Throws Error(argument) unless `path` ends with .png.
void require_png_name(const std::string& path);

/// Writes the bytes of a PNG. Throws Error(file) if the file cannot be written, and as require_png_name.
void write_png(const std::string& path, std::string_view png);

/// Writes the PNG that `draw` returns, as write_png.
void save_drawing(const std::string& path, const std::function<std::string(const VtkMessages&)>& draw);

}  // namespace insonify
