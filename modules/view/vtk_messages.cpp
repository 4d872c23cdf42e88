#include <algorithm>

#include <vtkObjectFactory.h>

#include "core/error.hpp"
#include "view/vtk_messages_internal.hpp"

namespace insonify {
namespace {

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

std::mutex& drawing_turn() {
  static std::mutex turn;
  return turn;
}

}  // namespace

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

}  // namespace insonify
