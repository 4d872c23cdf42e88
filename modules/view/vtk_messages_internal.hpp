#pragma once
#include <mutex>
#include <string>

#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace insonify {

/// During its lifetime, collects what VTK would print to stderr and lets only one thread draw, because VTK's text
/// renderer and message window exist once per process.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// Throws Error(runtime) with VTK's first error, if it reported any. Warnings are dropped.
  void throw_first_error(const char* who) const;

 private:
  std::unique_lock<std::mutex> turn_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkSmartPointer<vtkOutputWindow> collector_;
};

}  // namespace insonify
