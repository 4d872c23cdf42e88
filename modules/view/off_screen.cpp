// vtk_glew.h must precede every other GL header.
// clang-format off
#include <vtk_glew.h>
#include "view/off_screen_internal.hpp"
// clang-format on

#include <algorithm>
#include <filesystem>

#include <EGL/eglext.h>
#include <sys/mman.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "core/error.hpp"
#include "core/pending_file.hpp"
#include "core/text.hpp"

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

// Mesa does not check that it gets memory, but ends the process: that there is enough must be known before.
void require_memory(const char* who) {
  constexpr std::size_t needed = std::size_t{640} << 20;
  void* const room = mmap(nullptr, needed, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    fail(ErrorKind::runtime, who, ": too little memory for a picture: less than ", needed >> 20,
         " MiB are left; raise the limit (ulimit -v)");
  munmap(room, needed);
}

std::mutex& drawing_turn() {
  static std::mutex turn;
  return turn;
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
  require_memory(who);
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
    : turn_(drawing_turn()),
      before_(vtkOutputWindow::GetInstance()),
      collector_(vtkSmartPointer<MessageCollector>::New()) {
  vtkOutputWindow::SetInstance(collector_);
}

VtkMessages::~VtkMessages() { vtkOutputWindow::SetInstance(before_); }

void VtkMessages::throw_first_error(const char* who) const {
  std::string text = static_cast<const MessageCollector*>(collector_.Get())->first_error;
  if (text.empty()) return;
  std::replace(text.begin(), text.end(), '\n', ' ');
  fail(ErrorKind::runtime, who, ": VTK could not draw: ", text);
}

void write_png(vtkPNGWriter* writer, const std::string& path, const VtkMessages& messages, const char* who) {
  if (lower_case(std::filesystem::path(path).extension().string()) != ".png")
    fail(ErrorKind::argument, path, ": pictures are written as PNG; the name must end with .png");
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (writer->GetErrorCode() != vtkErrorCode::NoError || !png || png->GetNumberOfTuples() == 0)
    fail(ErrorKind::file, who, ": cannot make the PNG for ", path, ": ",
         vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  messages.throw_first_error(who);
  write_file(path,
             {reinterpret_cast<const char*>(png->GetPointer(0)), static_cast<std::size_t>(png->GetNumberOfTuples())});
}

void save_window(vtkRenderWindow* window, const std::string& path, const VtkMessages& messages, const char* who) {
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->SetInputBufferTypeToRGB();
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetCompressionLevel(3);
  write_png(writer, path, messages, who);
}

}  // namespace insonify
