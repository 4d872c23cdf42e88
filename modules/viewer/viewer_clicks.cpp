// Picking in a ViewerWindow: what a click selects.
#include <vtkCamera.h>

#include "viewer/viewer_window_internal.hpp"

namespace insonify {

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
