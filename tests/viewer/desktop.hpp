// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <sys/types.h>

namespace insonify {

/// A virtual X server, stopped by the destructor; the name is empty if Xvfb is not installed. Throws if it does not
/// answer.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  const std::string& name() const { return name_; }  ///< e.g. ":3"

 private:
  pid_t server_ = -1;
  void* client_ = nullptr;  ///< keeps the server from resetting when its last client leaves
  std::string name_;
};

/// A program on a display, with its output, and simulated clicks and keys.
class DesktopProgram {
 public:
  DesktopProgram(const VirtualDisplay& display, const std::vector<std::string>& command, const std::string& out_file);
  ~DesktopProgram();
  DesktopProgram(const DesktopProgram&) = delete;
  DesktopProgram& operator=(const DesktopProgram&) = delete;

  /// Waits for a window of this title. Returns false after 60 s.
  bool has_window(const std::string& title);
  void click(int x, int y) const;  ///< [pixels] from the window's upper left corner
  void type(const std::string& key_symbol) const;
  void close_window() const;  ///< presses the close button
  /// Returns the output once it contains `part`, or after `seconds`.
  std::string output_with(const std::string& part, double seconds = 30) const;
  int wait_for_end();  ///< returns the exit code; -1 if it had to be killed after 30 s

 private:
  void* display_ = nullptr;
  unsigned long window_ = 0;
  pid_t program_ = -1;
  std::string out_file_;
};

}  // namespace insonify
