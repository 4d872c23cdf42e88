#pragma once
#include <EGL/egl.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkSmartPointer.h>

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

}  // namespace insonify
