// SPDX-License-Identifier: BSD-3-Clause
// vtk_glew.h must precede every other GL header.
// clang-format off
#include <vtk_glew.h>
#include "view/off_screen_internal.hpp"
// clang-format on

#include <algorithm>
#include <filesystem>

#include <EGL/eglext.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/memory_limit.hpp"
#include "files/pending_file.hpp"

namespace insonify {
namespace {

// GLEW is built for GLX: it loads every GL function, then reports that there is no X display.
constexpr GLenum glew_no_glx_display = 4;

[[noreturn]] void no_gl(const char* who, const char* step) {
  fail(ErrorKind::runtime, who, ": no off-screen OpenGL (", step, " failed, EGL error ", eglGetError(),
       "); install libegl1 and libgl1-mesa-dri (Debian, Ubuntu), which render in software without a screen");
}

EGLDisplay surfaceless_display() {
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!get_display) return EGL_NO_DISPLAY;
  return get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

class MessageCollector : public vtkOutputWindow {
 public:
  static MessageCollector* New();
  vtkTypeMacro(MessageCollector, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (first_error.empty() && text) first_error = text;
  }

  std::string first_error;
};
vtkStandardNewMacro(MessageCollector);

// Mesa and its compiler take 700 MiB, and end the process if they do not get them; drawing does not begin with less.
constexpr std::size_t memory_of_a_picture = std::size_t{768} << 20;

[[noreturn]] void too_little_memory(const char* who, std::size_t left) {
  fail(ErrorKind::memory, who, ": too little memory for a picture: the limit (ulimit -v) leaves ", left >> 20,
       " MiB, a picture takes ", memory_of_a_picture >> 20, " and more; raise the limit");
}

}  // namespace

vtkStandardNewMacro(EglWindow);

EglWindow::EglWindow() { SetOffScreenRendering(1); }

EglWindow::~EglWindow() {
  if (context_ != EGL_NO_CONTEXT) Finalize();
  if (display_ == EGL_NO_DISPLAY) return;
  // The display belongs to the whole process: terminating it would destroy other contexts.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
}

void EglWindow::open(const char* who) {
  if (const auto left = memory_left(); left && *left < memory_of_a_picture) too_little_memory(who, *left);
  const EGLDisplay display = surfaceless_display();
  if (display == EGL_NO_DISPLAY) no_gl(who, "eglGetPlatformDisplayEXT");
  if (!eglInitialize(display, nullptr, nullptr)) no_gl(who, "eglInitialize");
  display_ = display;
  if (!eglBindAPI(EGL_OPENGL_API)) no_gl(who, "eglBindAPI");

  constexpr EGLint config_wish[][2] = {{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT},
                                       {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT},
                                       {EGL_RED_SIZE, 8},
                                       {EGL_GREEN_SIZE, 8},
                                       {EGL_BLUE_SIZE, 8},
                                       {EGL_ALPHA_SIZE, 8},
                                       {EGL_DEPTH_SIZE, 24},
                                       {EGL_NONE, 0}};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(display_, config_wish[0], &config, 1, &configs) || configs < 1) no_gl(who, "eglChooseConfig");
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE};
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
  if (context_ == EGL_NO_CONTEXT) no_gl(who, "eglCreateContext for OpenGL 3.2");

  // VTK renders into its own frame buffer; this surface only has to exist.
  const EGLint surface_size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  surface_ = eglCreatePbufferSurface(display_, config, surface_size);
  if (surface_ == EGL_NO_SURFACE) no_gl(who, "eglCreatePbufferSurface");
  if (!eglMakeCurrent(display_, surface_, surface_, context_)) no_gl(who, "eglMakeCurrent");
}

void EglWindow::MakeCurrent() { eglMakeCurrent(display_, surface_, surface_, context_); }

bool EglWindow::IsCurrent() { return context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_; }

void EglWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  if (Initialized) return;
  const GLenum answer = glewInit();
  GlewInitValid = answer == GLEW_OK || answer == glew_no_glx_display;
  if (!GlewInitValid) {
    vtkErrorMacro("GLEW could not load OpenGL, error " << answer);
    return;
  }
  float line_widths[2] = {1, 1};
  glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, line_widths);
  MaximumHardwareLineWidth = line_widths[1];
  // Shade every sample of a pixel separately: cells down to half a pixel contribute to the pixel's colour, and a
  // pixel inside one cell keeps that cell's colour exactly.
  if (MultiSamples > 1 && glMinSampleShading) {
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1.0F);
  }
  Initialized = true;
}

VtkMessages::VtkMessages()
    : before_(vtkOutputWindow::GetInstance()), collector_(vtkSmartPointer<MessageCollector>::New()) {
  vtkOutputWindow::SetInstance(collector_);
}

VtkMessages::~VtkMessages() { vtkOutputWindow::SetInstance(before_); }

void VtkMessages::throw_first_error(const char* who) const {
  std::string text = static_cast<const MessageCollector*>(collector_.Get())->first_error;
  if (text.empty()) return;
  std::replace(text.begin(), text.end(), '\n', ' ');
  fail(ErrorKind::runtime, who, ": VTK could not draw: ", text);
}

void require_png_name(const std::string& path) {
  if (lower_case(std::filesystem::path(path).extension().string()) != ".png")
    fail(ErrorKind::argument, path, ": pictures are written as PNG; the name must end with .png");
}

std::string bytes_of_png(vtkPNGWriter* writer, const VtkMessages& messages, const char* who) {
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (writer->GetErrorCode() != vtkErrorCode::NoError || !png || png->GetNumberOfTuples() == 0)
    fail(ErrorKind::runtime, who,
         ": cannot make a PNG: ", vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  messages.throw_first_error(who);
  return {reinterpret_cast<const char*>(png->GetPointer(0)), static_cast<std::size_t>(png->GetNumberOfTuples())};
}

void write_png(const std::string& path, std::string_view png) {
  require_png_name(path);
  write_file(path, png);
}

std::string png_of_window(vtkRenderWindow* window, const VtkMessages& messages, const char* who) {
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->SetInputBufferTypeToRGB();
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetCompressionLevel(3);
  return bytes_of_png(writer, messages, who);
}

void save_drawing(const std::string& path, const std::function<std::string(const VtkMessages&)>& draw) {
  require_png_name(path);
  const VtkMessages messages;
  write_file(path, draw(messages));
}

}  // namespace insonify
