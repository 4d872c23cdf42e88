// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/desktop.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <X11/Xlib.h>
#include <X11/keysym.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace insonify {
namespace {

// Polls until the condition holds. Returns false if the time has elapsed.
template <typename Condition>
bool comes_true(double seconds, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return condition();
}

pid_t start(const std::vector<std::string>& command, const std::string& display, const std::string& out_file) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (!display.empty()) setenv("DISPLAY", display.c_str(), 1);
  const int out = open(out_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (out >= 0) dup2(out, 1), dup2(out, 2);
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(127);
}

// Returns the window of that title below `parent`, or 0.
Window find_window(Display* display, Window parent, const std::string& title) {
  char* name = nullptr;
  if (XFetchName(display, parent, &name) && name) {
    const bool found = std::string(name).find(title) != std::string::npos;
    XFree(name);
    if (found) return parent;
  }
  Window root = 0, above = 0, *children = nullptr;
  unsigned count = 0;
  Window found = 0;
  if (XQueryTree(display, parent, &root, &above, &children, &count) && children) {
    for (unsigned i = 0; i < count && !found; ++i) found = find_window(display, children[i], title);
    XFree(children);
  }
  return found;
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  int answer[2];
  if (pipe(answer) != 0) return;
  server_ = fork();
  if (server_ == 0) {
    close(answer[0]);
    const std::string descriptor = std::to_string(answer[1]);
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, 1), dup2(nowhere, 2);
    execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1400x1000x24", "-nolisten", "tcp",
           static_cast<char*>(nullptr));
    _exit(127);
  }
  close(answer[1]);
  // Read the whole line, or the server would exit. Without Xvfb nothing arrives.
  std::string number;
  for (char c = 0; read(answer[0], &c, 1) == 1 && c != '\n';) number += c;
  close(answer[0]);
  if (number.empty()) return;
  name_.append(":").append(number);
  comes_true(20, [this] { return (client_ = XOpenDisplay(name_.c_str())) != nullptr; });
  if (!client_) throw std::runtime_error("Xvfb does not answer on " + name_);
}

VirtualDisplay::~VirtualDisplay() {
  if (client_) XCloseDisplay(static_cast<Display*>(client_));
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

DesktopProgram::DesktopProgram(const VirtualDisplay& display, const std::vector<std::string>& command,
                               const std::string& out_file)
    : display_(XOpenDisplay(display.name().c_str())),
      program_(start(command, display.name(), out_file)),
      out_file_(out_file) {}

DesktopProgram::~DesktopProgram() {
  if (program_ > 0) {
    kill(program_, SIGKILL);
    waitpid(program_, nullptr, 0);
  }
  if (display_) XCloseDisplay(static_cast<Display*>(display_));
}

bool DesktopProgram::has_window(const std::string& title) {
  auto* display = static_cast<Display*>(display_);
  if (!display) return false;
  return comes_true(60, [&] {
    window_ = find_window(display, DefaultRootWindow(display), title);
    XWindowAttributes attributes{};
    return window_ != 0 && XGetWindowAttributes(display, window_, &attributes) && attributes.map_state == IsViewable;
  });
}

void DesktopProgram::click(int x, int y) const {
  auto* display = static_cast<Display*>(display_);
  XEvent event{};
  event.xmotion.type = MotionNotify;
  event.xmotion.display = display;
  event.xmotion.window = window_;
  event.xmotion.x = x;
  event.xmotion.y = y;
  event.xmotion.same_screen = True;
  XSendEvent(display, window_, True, PointerMotionMask, &event);
  for (const int type : {ButtonPress, ButtonRelease}) {
    XEvent button{};
    button.xbutton.type = type;
    button.xbutton.display = display;
    button.xbutton.window = window_;
    button.xbutton.x = x;
    button.xbutton.y = y;
    button.xbutton.button = Button1;
    button.xbutton.same_screen = True;
    XSendEvent(display, window_, True, type == ButtonPress ? ButtonPressMask : ButtonReleaseMask, &button);
  }
  XFlush(display);
}

void DesktopProgram::type(const std::string& key_symbol) const {
  auto* display = static_cast<Display*>(display_);
  for (const int type : {KeyPress, KeyRelease}) {
    XEvent key{};
    key.xkey.type = type;
    key.xkey.display = display;
    key.xkey.window = window_;
    key.xkey.root = DefaultRootWindow(display);
    key.xkey.keycode = XKeysymToKeycode(display, XStringToKeysym(key_symbol.c_str()));
    key.xkey.same_screen = True;
    XSendEvent(display, window_, True, type == KeyPress ? KeyPressMask : KeyReleaseMask, &key);
  }
  XFlush(display);
}

void DesktopProgram::close_window() const {
  auto* display = static_cast<Display*>(display_);
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window_;
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, window_, False, NoEventMask, &event);
  XFlush(display);
}

std::string DesktopProgram::output_with(const std::string& part, double seconds) const {
  std::string text;
  comes_true(seconds, [&] {
    std::ifstream file(out_file_);
    text.assign(std::istreambuf_iterator<char>(file), {});
    return text.find(part) != std::string::npos;
  });
  return text;
}

int DesktopProgram::wait_for_end() {
  int status = 0;
  if (!comes_true(30, [&] { return waitpid(program_, &status, WNOHANG) == program_; })) return -1;
  program_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace insonify
