#include <cctype>
#include <cmath>

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include "viewer/viewer_style_internal.hpp"

namespace insonify {
namespace {

constexpr double still_a_click = 3;  // [pixels] between press and release

}  // namespace

vtkStandardNewMacro(ViewerStyle);

Point2 ViewerStyle::pointer() const {
  const int* at = Interactor->GetEventPosition();
  return {static_cast<double>(at[0]), static_cast<double>(at[1])};
}

void ViewerStyle::OnLeftButtonDown() {
  pressed_ = pointer();
  if (motion() == PanelMotion::turn) Superclass::OnLeftButtonDown();
  if (motion() == PanelMotion::slide) Superclass::OnMiddleButtonDown();
}

void ViewerStyle::OnLeftButtonUp() {
  if (State == VTKIS_PAN)
    Superclass::OnMiddleButtonUp();
  else
    Superclass::OnLeftButtonUp();
  come_to_rest();
  const Point2 at = pointer();
  if (std::hypot(at.x - pressed_.x, at.y - pressed_.y) <= still_a_click) on_click(at);
}

void ViewerStyle::OnMiddleButtonDown() {
  if (motion() != PanelMotion::none) Superclass::OnMiddleButtonDown();
}

void ViewerStyle::OnRightButtonDown() {
  if (motion() != PanelMotion::none) Superclass::OnRightButtonDown();
}

void ViewerStyle::OnMiddleButtonUp() {
  Superclass::OnMiddleButtonUp();
  come_to_rest();
}

void ViewerStyle::OnRightButtonUp() {
  Superclass::OnRightButtonUp();
  come_to_rest();
}

void ViewerStyle::come_to_rest() {
  if (!moving_) return;
  moving_ = false;
  on_moving(false);
}

void ViewerStyle::OnMouseMove() {
  if (State != VTKIS_NONE && !moving_) {
    moving_ = true;
    on_moving(true);
  }
  Superclass::OnMouseMove();
}

void ViewerStyle::OnMouseWheelForward() {
  if (motion() != PanelMotion::none) Superclass::OnMouseWheelForward();
}

void ViewerStyle::OnMouseWheelBackward() {
  if (motion() != PanelMotion::none) Superclass::OnMouseWheelBackward();
}

void ViewerStyle::OnKeyPress() {
  const char* symbol = Interactor->GetKeySym();
  if (symbol) on_key(key_name(symbol, Interactor->GetShiftKey() != 0));
}

std::string key_name(const std::string& symbol, bool shift) {
  const bool moves = symbol == "Left" || symbol == "Right" || symbol == "Up" || symbol == "Down" || symbol == "Prior" ||
                     symbol == "Next";
  if (shift && moves) return "shift+" + symbol;
  if (symbol.size() != 1) return symbol;
  return std::string(1, static_cast<char>(std::tolower(static_cast<unsigned char>(symbol[0]))));
}

}  // namespace insonify
