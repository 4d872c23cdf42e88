// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <vtkLogger.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "scene_io/text_lines_internal.hpp"

// Private to scene_io: what VTK's readers say.
namespace insonify {

/// Collects what VTK would print.
class VtkReadMessages : public vtkOutputWindow {
 public:
  static VtkReadMessages* New() { return new VtkReadMessages; }
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { add(errors, text); }
  void DisplayWarningText(const char* text) override { add(warnings, text); }
  /// The legacy reader warns of missing numbers with a text that begins with Error.
  void DisplayGenericWarningText(const char* text) override {
    add(std::string_view(text).find("Error") == std::string_view::npos ? warnings : errors, text);
  }
  void DisplayDebugText(const char*) override {}
  std::vector<std::string> errors, warnings;

 private:
  /// VTK's text is "ERROR: In file.cxx, line n\nvtkX (0x..): message\n\n": the message alone is kept.
  void add(std::vector<std::string>& list, const char* text) {
    std::string message = text;
    message.erase(0, std::min(message.find('\n') + 1, message.size()));
    const std::size_t head = message.find("): ");
    if (head != message.npos) message.erase(0, head + 3);
    list.push_back(shown(message.substr(0, message.find('\n'))));
  }
};

/// Puts `messages` in the place of VTK's console and silences its log while it lives.
class QuietVtk {
 public:
  explicit QuietVtk(vtkOutputWindow* messages) : before_(vtkOutputWindow::GetInstance()) {
    vtkOutputWindow::SetInstance(messages);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~QuietVtk() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
};

}  // namespace insonify
