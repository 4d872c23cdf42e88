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
#include "viewer/viewer_window_internal.hpp"

// Picking in a ViewerWindow: what a click selects.
namespace insonify {
namespace {

constexpr double still_a_click = 3;  // [pixels] between press and release

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

Point2 ViewerWindow::on_panel(const Box& box, Point2 place) const { return {place.x - box.left, place.y - box.bottom}; }

// Converts a place in the window to the fan's plane, since its camera may have moved.
Point2 ViewerWindow::on_fan(Point2 place) const {
  const Point2 own = on_panel(layout_.fan, place);
  vtkCamera* camera = fan_.content->GetActiveCamera();
  const double per_pixel = 2 * camera->GetParallelScale() / layout_.fan.height();
  const double* focus = camera->GetFocalPoint();
  return {focus[0] + (own.x - layout_.fan.width() / 2) * per_pixel,
          focus[1] + (own.y - layout_.fan.height() / 2) * per_pixel};
}

Point2 ViewerWindow::pixel_of(PixelPlace place) const {
  const Point2 at = fan_layout_.at(-image_->fan.azimuth[place.beam], image_->gate.centre(place.bin));
  vtkCamera* camera = fan_.content->GetActiveCamera();
  const double per_pixel = 2 * camera->GetParallelScale() / layout_.fan.height();
  const double* focus = camera->GetFocalPoint();
  return {layout_.fan.left + layout_.fan.width() / 2 + (at.x - focus[0]) / per_pixel,
          layout_.fan.bottom + layout_.fan.height() / 2 + (at.y - focus[1]) / per_pixel};
}

std::optional<Point2> ViewerWindow::pixel_of_point(const Eigen::Vector3d& world) const {
  if (!scene_) return {};
  return scene_->pixel_of(world);
}

PanelMotion ViewerWindow::motion_at(Point2 place) const {
  const auto panel = panel_at(layout_, place);
  if (panel == ViewerPanelName::scene) return PanelMotion::turn;
  return panel == ViewerPanelName::fan ? PanelMotion::slide : PanelMotion::none;
}

void ViewerWindow::click(Point2 place) {
  const auto panel = panel_at(layout_, place);
  if (panel == ViewerPanelName::fan) click_fan(place);
  if (panel == ViewerPanelName::scene) click_scene(place);
  if (panel == ViewerPanelName::ascan) click_ascan(place);
}

void ViewerWindow::click_fan(Point2 place) {
  const FanPlace at = fan_place(fan_layout_, on_fan(place));
  if (const auto pixel = pixel_at(*image_, at)) select(*pixel, metres_on_fan(at));
}

void ViewerWindow::click_scene(Point2 place) {
  if (state_.mode == ViewerMode::inspect) {
    ViewerState next = state_;
    next.surfel = scene_->surfel_at(place);
    change(next);
    if (state_.surfel) say(explanation_);
    return;
  }
  const auto world = scene_->world_at(place);
  if (!world) return;
  const auto pixel = place_of(data_.pings[state_.ping], *world);
  if (!pixel) {
    notice_ = "this point lies outside fan and range gate";
    return draw();
  }
  const double bearing = -image_->fan.azimuth[pixel->beam];
  select(*pixel, metres_on_fan({bearing, image_->gate.centre(pixel->bin)}));
}

void ViewerWindow::click_ascan(Point2 place) {
  const auto bin = bin_at(*image_, ascan_axes_, on_panel(layout_.ascan, place));
  if (!bin) return;
  ViewerState next = state_;
  next.selected = PixelPlace{shown_place().beam, *bin};
  change(next);
  say(explanation_);
}

void ViewerWindow::select(PixelPlace place, const Eigen::Vector2d& at) {
  const bool measures = state_.measure.active;
  notice_.clear();
  change(select_pixel(state_, place, at, extent_));
  if (!measures) say(explanation_);
}

}  // namespace insonify
