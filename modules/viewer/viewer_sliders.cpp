#include <cmath>

#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkProperty2D.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkTextProperty.h>

#include "view/canvas_internal.hpp"
#include "view/fonts_internal.hpp"
#include "viewer/viewer_sliders_internal.hpp"

namespace insonify {
namespace {

vtkSliderRepresentation2D* shape_of(vtkSliderWidget* slider) {
  return vtkSliderRepresentation2D::SafeDownCast(slider->GetRepresentation());
}

vtkSmartPointer<vtkSliderWidget> make_slider(const char* title, double low, double high) {
  vtkNew<vtkSliderRepresentation2D> shape;
  shape->SetMinimumValue(low);
  shape->SetMaximumValue(high);
  shape->SetTitleText(title);
  shape->SetLabelFormat("%.0f dB");
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

ViewerSliders::ViewerSliders(vtkRenderWindow* window, vtkRenderWindowInteractor* interactor,
                             std::function<void(double, double)> moved)
    : renderer_(vtkSmartPointer<vtkRenderer>::New()),
      slider_{make_slider("Gain", -40, 40), make_slider("Window", 5, 150)},
      moved_(std::move(moved)) {
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
  renderer_->GetActiveCamera();  // creates it; window coordinates are computed through it
  window->AddRenderer(renderer_);
  for (const auto& slider : slider_) {
    slider->SetInteractor(interactor);
    slider->SetDefaultRenderer(renderer_);
    slider->SetCurrentRenderer(renderer_);
    slider->EnabledOn();
    slider->AddObserver(vtkCommand::InteractionEvent, this, &ViewerSliders::notify);
  }
}

void ViewerSliders::place(const Box& room, const int window_size[2], int font_size) {
  const double width = window_size[0], height = window_size[1];
  for (std::size_t i = 0; i < slider_.size(); ++i) {
    vtkSliderRepresentation2D* shape = shape_of(slider_[i]);
    const double y = room.bottom + (i == 0 ? 0.75 : 0.25) * room.height();
    shape->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
    shape->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
    shape->GetPoint1Coordinate()->SetValue(room.left / width, y / height);
    shape->GetPoint2Coordinate()->SetValue(room.right / width, y / height);
    // Letter heights are fractions of the window.
    shape->SetTitleHeight(font_size / height);
    shape->SetLabelHeight(font_size / height);
  }
}

void ViewerSliders::set(double gain_db, double window_db) {
  shape_of(slider_[0])->SetValue(gain_db);
  shape_of(slider_[1])->SetValue(window_db);
}

void ViewerSliders::notify() { moved_(shape_of(slider_[0])->GetValue(), shape_of(slider_[1])->GetValue()); }

}  // namespace insonify
