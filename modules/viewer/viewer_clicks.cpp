// SPDX-License-Identifier: BSD-3-Clause
// Implements the clicks of a ViewerWindow.
#include <vtkCamera.h>

#include "viewer/viewer_window_internal.hpp"

namespace insonify {

Point2 ViewerWindow::on_panel(ViewerPanelName name, Point2 position) const {
  const Box& box = box_of(layout_, name);
  return {position.x - box.left, position.y - box.bottom};
}

// Converts a position in the window to the fan's plane, since its camera may have moved.
Point2 ViewerWindow::on_fan(Point2 position) const {
  const Point2 own = on_panel(ViewerPanelName::fan, position);
  vtkCamera* camera = panel(ViewerPanelName::fan).content->GetActiveCamera();
  const double per_pixel = 2 * camera->GetParallelScale() / layout_.fan.height();
  const double* focus = camera->GetFocalPoint();
  return {focus[0] + (own.x - layout_.fan.width() / 2) * per_pixel,
          focus[1] + (own.y - layout_.fan.height() / 2) * per_pixel};
}

Point2 ViewerWindow::pixel_of(PixelPosition position) const {
  const Point2 at = fan_layout_.at(-image_->fan.azimuth[position.beam], image_->gate.centre(position.bin));
  vtkCamera* camera = panel(ViewerPanelName::fan).content->GetActiveCamera();
  const double per_pixel = 2 * camera->GetParallelScale() / layout_.fan.height();
  const double* focus = camera->GetFocalPoint();
  return {layout_.fan.left + layout_.fan.width() / 2 + (at.x - focus[0]) / per_pixel,
          layout_.fan.bottom + layout_.fan.height() / 2 + (at.y - focus[1]) / per_pixel};
}

std::optional<Point2> ViewerWindow::pixel_of_point(const Eigen::Vector3d& world) const {
  if (!scene_) return {};
  return scene_->pixel_of(world);
}

PanelMotion ViewerWindow::motion_at(Point2 position) const {
  const auto panel = panel_at(layout_, position);
  if (panel == ViewerPanelName::scene) return PanelMotion::turn;
  return panel == ViewerPanelName::fan ? PanelMotion::slide : PanelMotion::none;
}

std::optional<Point2> ViewerWindow::pixel_of_button(const std::string& key) const {
  for (const PlacedButton& button : buttons_)
    if (button.key == key)
      return Point2{(button.box.left + button.box.right) / 2, (button.box.bottom + button.box.top) / 2};
  return {};
}

void ViewerWindow::click(Point2 position) {
  for (const PlacedButton& button : buttons_)
    if (button.box.holds(position)) return press_key(std::string(button.key));
  const auto name = panel_at(layout_, position);
  if (!name) return;
  if (const auto act = panels_[static_cast<std::size_t>(*name)].click) (this->*act)(position);
}

void ViewerWindow::click_fan(Point2 position) {
  if (is_waterfall()) return select_on_waterfall(picture_axes_, picture_page_, on_fan(position));
  const FanPosition at = fan_position(fan_layout_, on_fan(position));
  const LevelImage& shown = picture_ == ViewerPicture::sweep ? sweep_.image : *image_;
  const auto pixel = pixel_at(shown, at);
  if (!pixel) return;
  if (picture_ == ViewerPicture::fan || state_.measure.active) return select(*pixel, metres_on_fan(at));
  change(select_ping(state_, sweep_.ping[pixel->beam], {0, pixel->bin}, extent_));
  say(explanation_);
}

void ViewerWindow::click_history(Point2 position) {
  if (extent_.pings > 1)
    select_on_waterfall(history_axes_, history_page_, on_panel(ViewerPanelName::history, position));
}

void ViewerWindow::select_on_waterfall(const Axes& axes, const BeamPage& page, Point2 position) {
  std::size_t beam = page.beam;
  const bool both = picture_ == ViewerPicture::sides && &page == &picture_page_;
  if (both) beam = position.x < (axes.frame.left + axes.frame.right) / 2 ? 0 : 1;
  if (both && beam == 0) position.x = axes.frame.left + axes.frame.right - position.x;  // where starboard is as far
  const auto row = row_at(axes, position);
  const auto bin = bin_at(*image_, axes, position);
  if (!row || !bin) return;
  notice_.clear();
  change(select_ping(state_, page.first + *row, {beam, *bin}, extent_));
  say(explanation_);
}

void ViewerWindow::click_scene(Point2 position) {
  if (state_.mode == ViewerMode::inspect) {
    ViewerState next = state_;
    next.surfel = scene_->surfel_at(position);
    change(next);
    if (state_.surfel) say(explanation_);
    return;
  }
  const auto world = scene_->world_at(position);
  if (!world) return;
  const auto pixel = position_of(*data_.pings.ping(state_.ping), *world);
  if (!pixel) {
    notice_ = "this point lies outside the fan or the range";
    return draw();
  }
  const double bearing = -image_->fan.azimuth[pixel->beam];
  select(*pixel, metres_on_fan({bearing, image_->gate.centre(pixel->bin)}));
}

void ViewerWindow::click_ascan(Point2 position) {
  const auto bin = bin_at(*image_, ascan_axes_, on_panel(ViewerPanelName::ascan, position));
  if (!bin) return;
  ViewerState next = state_;
  next.selected = PixelPosition{shown_position().beam, *bin};
  change(next);
  say(explanation_);
}

void ViewerWindow::select(PixelPosition position, const Eigen::Vector2d& at) {
  const bool measures = state_.measure.active;
  notice_.clear();
  change(select_pixel(state_, position, at, extent_));
  if (!measures) say(explanation_);
}

}  // namespace insonify
