// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>
#include <cmath>

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkObjectFactory.h>
#include <vtkProperty2D.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkTextProperty.h>

#include "view/canvas_internal.hpp"
#include "viewer/viewer_controls_internal.hpp"

namespace insonify {
namespace {

constexpr double still_a_click = 3;  // between press and release [pixels]

vtkSliderRepresentation2D* shape_of(vtkSliderWidget* slider) {
  return vtkSliderRepresentation2D::SafeDownCast(slider->GetRepresentation());
}

vtkSmartPointer<vtkSliderWidget> make_slider(const char* title, const char* label, double low, double high) {
  vtkNew<vtkSliderRepresentation2D> shape;
  shape->SetMinimumValue(low);
  shape->SetMaximumValue(high);
  shape->SetTitleText(title);
  shape->SetLabelFormat(label);
  const Theme colours = theme(true);
  shape->GetTubeProperty()->SetColor(colours.line[0], colours.line[1], colours.line[2]);
  shape->GetCapProperty()->SetColor(colours.line[0], colours.line[1], colours.line[2]);
  shape->GetSliderProperty()->SetColor(colours.text[0], colours.text[1], colours.text[2]);
  shape->GetSelectedProperty()->SetColor(0.98, 0.66, 0.25);
  for (vtkTextProperty* text : {shape->GetTitleProperty(), shape->GetLabelProperty()}) {
    set_font(text, 12);
    text->SetColor(colours.text[0], colours.text[1], colours.text[2]);
  }
  shape->SetSliderLength(0.008);
  shape->SetSliderWidth(0.018);
  shape->SetTubeWidth(0.005);
  shape->SetEndCapLength(0);
  shape->SetEndCapWidth(0.005);
  auto slider = vtkSmartPointer<vtkSliderWidget>::New();
  slider->SetRepresentation(shape);
  slider->SetAnimationModeToJump();
  slider->KeyPressActivationOff();
  return slider;
}

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

ViewerSliders::ViewerSliders(vtkRenderWindow* window, vtkRenderWindowInteractor* interactor, std::size_t pings,
                             std::function<void(double, double, double)> moved)
    : renderer_(vtkSmartPointer<vtkRenderer>::New()),
      slider_{make_slider("Gain", "%.0f dB", -40, 40), make_slider("Window", "%.0f dB", 5, 150)},
      moved_(std::move(moved)) {
  if (pings > 1) slider_.push_back(make_slider("", "%.0f", 0, static_cast<double>(pings - 1)));
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
  renderer_->GetActiveCamera();  // creates the camera, through which window coordinates are computed
  window->AddRenderer(renderer_);
  for (const auto& slider : slider_) {
    slider->SetInteractor(interactor);
    slider->SetDefaultRenderer(renderer_);
    slider->SetCurrentRenderer(renderer_);
    slider->EnabledOn();
    slider->AddObserver(vtkCommand::InteractionEvent, this, &ViewerSliders::notify);
  }
  if (pings > 1) shape_of(slider_[2])->ShowSliderLabelOff();  // the status line shows it
}

void ViewerSliders::lay_out(const Box& room, const Box& timeline, const int window_size[2], int font_size) {
  const double width = window_size[0], height = window_size[1];
  for (std::size_t i = 0; i < slider_.size(); ++i) {
    vtkSliderRepresentation2D* shape = shape_of(slider_[i]);
    const bool of_pings = i == 2;
    const double left = of_pings ? timeline.left + 2 * font_size : room.left;
    const double right = of_pings ? timeline.right - 2 * font_size : room.right;
    const double y =
        of_pings ? (timeline.bottom + timeline.top) / 2 : room.bottom + (i == 0 ? 0.75 : 0.25) * room.height();
    shape->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
    shape->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
    shape->GetPoint1Coordinate()->SetValue(left / width, y / height);
    shape->GetPoint2Coordinate()->SetValue(right / width, y / height);
    // Letter heights are fractions of the window.
    shape->SetTitleHeight(font_size / height);
    shape->SetLabelHeight(font_size / height);
  }
}

void ViewerSliders::set(double gain_db, double window_db, double ping) {
  shape_of(slider_[0])->SetValue(gain_db);
  shape_of(slider_[1])->SetValue(window_db);
  if (slider_.size() > 2) shape_of(slider_[2])->SetValue(ping);
}

void ViewerSliders::notify() {
  moved_(shape_of(slider_[0])->GetValue(), shape_of(slider_[1])->GetValue(),
         slider_.size() > 2 ? shape_of(slider_[2])->GetValue() : 0);
}

}  // namespace insonify
