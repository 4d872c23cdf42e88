// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "view/axes_internal.hpp"
#include "view/scene_lines_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double along_view = 0.96;    // cosine above which an axis is along the line of sight
constexpr double tick_length = 0.015;  // fraction of the diagonal

// An edge of the box that carries the values of one axis.
struct AxisEdge {
  int axis = 0;
  Vector3d low, high;  // ends
  Vector3d outward;
};

// Returns the one of the two floor edges along `axis` that is nearer to the camera.
AxisEdge floor_edge(const Eigen::AlignedBox3d& box, int axis, const CameraView& view) {
  const int other = 1 - axis;
  const double looks = view.position[other] - box.center()[other] - view.forward()[other] * 1e-9;
  // From straight above, take the edge at the bottom or left of the picture.
  const bool from_above = std::abs(view.forward().z()) > along_view;
  const bool at_high = !from_above && looks > 0;
  AxisEdge edge{axis, box.min(), box.min(), Vector3d::Zero()};
  edge.low[other] = edge.high[other] = at_high ? box.max()[other] : box.min()[other];
  edge.high[axis] = box.max()[axis];
  edge.outward[other] = at_high ? 1 : -1;
  return edge;
}

// Returns the vertical edge that is leftmost in the picture.
AxisEdge upright_edge(const Eigen::AlignedBox3d& box, const CameraView& view) {
  AxisEdge best;
  double leftmost = 1e300;
  for (const double x : {box.min().x(), box.max().x()})
    for (const double y : {box.min().y(), box.max().y()}) {
      const double across = show_point(view, {x, y, box.min().z()}, 1, 1).at.x;
      if (across >= leftmost) continue;
      leftmost = across;
      best = {2, {x, y, box.min().z()}, {x, y, box.max().z()}, Vector3d::Zero()};
    }
  best.outward = -view.forward().cross(view.up).normalized();
  return best;
}

// Returns the step of ticks: about five along the longest side, the same for x and y.
double tick_step(double length) { return round_step(std::max(length, 1e-6) / 6); }

void add_axis(SceneAxes& axes, const AxisEdge& edge, double step, double origin, double tick) {
  const int axis = edge.axis;
  const auto position_of = [&](double world) {
    Vector3d position = edge.low;
    position[axis] = world - origin;
    return position;
  };
  for (const double value : multiples(step, edge.low[axis] + origin, edge.high[axis] + origin)) {
    const Vector3d position = position_of(value);
    axes.ticks.push_back({position, position + tick * edge.outward});
    axes.labels.push_back({number_text(value, step), position + tick * edge.outward, edge.outward, false});
  }
  const Vector3d middle = (edge.low + edge.high) / 2;
  axes.labels.push_back({std::string(1, "xyz"[axis]) + " [m]", middle + tick * edge.outward, edge.outward, true});
}

// A label that can be moved outwards from its position.
class OutwardText {
 public:
  OutwardText(const AxisLabel& label, const CameraView& view, const Box& frame, int font_size)
      : text_(label.text, {}, font_size) {
    const ShownPoint at = show_point(view, label.position, frame.width(), frame.height());
    const ShownPoint out =
        show_point(view, label.position + 1e-3 * at.distance * label.outward, frame.width(), frame.height());
    text_.on_plate = true;
    visible_ = at.distance > 0 && out.distance > 0;
    start_ = {frame.left + at.at.x, frame.bottom + at.at.y};
    const double dx = out.at.x - at.at.x, dy = out.at.y - at.at.y, length = std::max(std::hypot(dx, dy), 1e-9);
    outward_ = {dx / length, dy / length};
  }
  bool visible() const { return visible_; }
  const PlacedText& text() const { return text_; }
  // Moves the label to `away` pixels from its position.
  void put(double away) {
    text_.centre = {start_.x + outward_.x * (text_.extent.width / 2 + away),
                    start_.y + outward_.y * (text_.extent.height / 2 + away)};
  }

 private:
  PlacedText text_;
  bool visible_;
  Point2 start_, outward_;
};

bool has_room(const Box& box, const Box& frame, const std::vector<PlacedText>& taken, double gap) {
  const Box wide{box.left - gap, box.right + gap, box.bottom, box.top};
  return frame.contains(box) &&
         std::none_of(taken.begin(), taken.end(), [&](const PlacedText& other) { return other.box().overlaps(wide); });
}

}  // namespace

std::vector<PlacedText> place_labels(const std::vector<AxisLabel>& labels, const CameraView& view, const Box& frame,
                                     int font_size) {
  constexpr double farthest = 6;  // largest outward move of a name, in font sizes
  std::vector<PlacedText> placed;
  for (const bool names : {false, true})
    for (const AxisLabel& label : labels) {
      if (label.is_name != names) continue;
      OutwardText text(label, view, frame, font_size);
      if (!text.visible()) continue;
      double away = (names ? 1.5 : 0.3) * font_size;
      for (text.put(away); names && away < farthest * font_size; text.put(away += 0.3 * font_size))
        if (has_room(text.text().box(), frame, placed, 0.8 * font_size)) break;
      if (has_room(text.text().box(), frame, placed, 0.4 * font_size)) placed.push_back(text.text());
    }
  return placed;
}

SceneAxes lay_out_axes(const Eigen::AlignedBox3d& box, const Vector3d& scene_origin, const CameraView& view) {
  SceneAxes axes;
  const Vector3d low = box.min(), high = box.max(), forward = view.forward();
  const double step = tick_step(std::max(high.x() - low.x(), high.y() - low.y()));
  const double tick = tick_length * box.diagonal().norm();

  axes.edges.push_back(
      {low, {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()}, {low.x(), high.y(), low.z()}, low});
  for (const double x : multiples(step, low.x() + scene_origin.x(), high.x() + scene_origin.x()))
    axes.grid.push_back({{x - scene_origin.x(), low.y(), low.z()}, {x - scene_origin.x(), high.y(), low.z()}});
  for (const double y : multiples(step, low.y() + scene_origin.y(), high.y() + scene_origin.y()))
    axes.grid.push_back({{low.x(), y - scene_origin.y(), low.z()}, {high.x(), y - scene_origin.y(), low.z()}});

  for (const int axis : {0, 1})
    if (std::abs(forward[axis]) < along_view)
      add_axis(axes, floor_edge(box, axis, view), step, scene_origin[axis], tick);
  if (std::abs(forward.z()) < along_view && high.z() > low.z()) {
    const AxisEdge edge = upright_edge(box, view);
    axes.edges.push_back({edge.low, edge.high});
    add_axis(axes, edge, round_step(std::max((high.z() - low.z()) / 5, step / 10)), scene_origin.z(), tick);
  }
  return axes;
}

}  // namespace insonify
