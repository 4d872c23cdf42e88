// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "view/scene_camera_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_points = 20000;

struct ViewAxes {
  Vector3d right, up, forward;
};
ViewAxes view_axes(const Vector3d& forward, const Vector3d& up) {
  const Vector3d right = forward.cross(up).normalized();
  return {right, right.cross(forward), forward};
}

// Returns the horizontal direction in which a track begins, otherwise the forward direction of the head in the
// horizontal plane; for a vertical head, the upward direction of its picture.
Vector3d heading(const SceneLook& look) {
  if (!look.head) return Vector3d::UnitX();
  for (const Vector3d& position : look.track) {
    const Vector3d way = position - look.track.front();
    if (std::hypot(way.x(), way.y()) > 1e-3) return Vector3d(way.x(), way.y(), 0).normalized();
  }
  const auto turn = look.head->world_from_head.linear();
  Vector3d ahead = turn.col(0);
  if (std::hypot(ahead.x(), ahead.y()) < 1e-6) ahead = ahead.z() < 0 ? turn.col(2) : Vector3d(-turn.col(2));
  return Vector3d(ahead.x(), ahead.y(), 0).normalized();
}

constexpr double shallow_deg = 30, steep_deg = 60;  // slopes of the view from behind the head

// Returns the axes of a preset; the view from behind looks down by `behind_deg`.
ViewAxes preset_axes(const SceneLook& look, ScenePreset preset, double behind_deg) {
  const Vector3d up = Vector3d::UnitZ(), ahead = heading(look);
  const auto downwards = [&](const Vector3d& level, double angle_deg) {
    return Vector3d(std::cos(radians(angle_deg)) * level - std::sin(radians(angle_deg)) * up);
  };
  if (preset == ScenePreset::automatic) preset = look.head ? ScenePreset::behind : ScenePreset::iso;
  if (preset == ScenePreset::behind) return view_axes(downwards(ahead, behind_deg), up);
  if (preset == ScenePreset::top) return view_axes(-up, Vector3d::UnitY());
  if (preset == ScenePreset::side) return view_axes(downwards(up.cross(ahead), 8), up);
  return view_axes(downwards(Vector3d(0.64, 0.77, 0).normalized(), 32), up);
}

// A position of the camera, and how far it may rise with all points still in the window.
struct FittingPosition {
  Vector3d at;
  double slack_up = 0;
};

// Returns the nearest position from which all points lie within the window. `open_x` and `open_y` are the tangents of
// half its view angles.
FittingPosition fitting_position(const std::vector<Vector3d>& points, const ViewAxes& axes, double open_x,
                                 double open_y) {
  // A point is inside if its offset to the right is at most its distance times open_x. This gives two bounds on the
  // lateral position of the camera, whose gap closes as it moves nearer; likewise upwards.
  double left = -1e300, right = 1e300, low = -1e300, high = 1e300, nearest = 1e300;
  for (const Vector3d& point : points) {
    const double x = axes.right.dot(point), y = axes.up.dot(point), z = axes.forward.dot(point);
    left = std::max(left, x - open_x * z), right = std::min(right, x + open_x * z);
    low = std::max(low, y - open_y * z), high = std::min(high, y + open_y * z);
    nearest = std::min(nearest, z);
  }
  // A single point is viewed from a distance of one metre.
  const double z = std::min({(right - left) / (2 * open_x), (high - low) / (2 * open_y), nearest - 1e-3});
  const double at = points.size() == 1 ? z - 1 : z;
  return {(left + right) / 2 * axes.right + (low + high) / 2 * axes.up + at * axes.forward,
          std::max(0.0, (high - low) / 2 - open_y * at)};
}

// The extent of points in a picture, as tangents of the angles above its middle.
struct HeightSpan {
  double low = 1e300, high = -1e300;
  void add(const Vector3d& from_eye, const ViewAxes& axes) {
    const double distance = axes.forward.dot(from_eye), at = axes.up.dot(from_eye) / distance;
    if (distance > 0) low = std::min(low, at), high = std::max(high, at);
  }
};
HeightSpan height_span(const std::vector<Vector3d>& points, const ViewAxes& axes, const Vector3d& position) {
  HeightSpan span;
  for (const Vector3d& point : points) span.add(point - position, axes);
  return span;
}

// Returns true if the scene goes on above the points of interest.
bool goes_on_above(const SceneCloud& scene, const ViewAxes& axes, const Vector3d& position, double high) {
  HeightSpan span;
  for (std::size_t i = 0; i < scene.size(); i += 1 + scene.size() / most_points)
    span.add(scene.point[i].cast<double>() - position, axes);
  return span.high > high + 0.02;
}

// Returns positions along the track of the head, at most `most` of them.
std::vector<Vector3d> way_of(const SceneCloud& scene, const SceneLook& look) {
  constexpr std::size_t most = 64;
  const std::size_t step = 1 + look.track.size() / most;
  std::vector<Vector3d> way;
  for (std::size_t i = 0; i < look.track.size(); i += step) way.emplace_back(look.track[i] - scene.origin);
  if (way.size() > 1) way.emplace_back(look.track.back() - scene.origin);
  return way;
}

}  // namespace

std::vector<Vector3d> points_of_interest(const SceneCloud& scene, const SceneLook& look) {
  std::vector<Vector3d> points, all;
  const std::size_t step = 1 + scene.size() / most_points;
  // Include the whole track of a head that moves, so that a playing picture keeps its frame.
  std::vector<Vector3d> heads;
  if (look.head) heads = way_of(scene, look);
  if (look.head && heads.size() < 2) heads = {look.head->world_from_head.translation() - scene.origin};
  const auto is_insonified = [&](const Vector3d& point) {
    return std::any_of(heads.begin(), heads.end(),
                       [&](const Vector3d& head) { return (point - head).norm() <= look.head->gate.max_range; });
  };
  for (std::size_t i = 0; i < scene.size(); i += step) {
    all.push_back(scene.point[i].cast<double>());
    if (is_insonified(all.back())) points.push_back(all.back());
  }
  // Show a scene whole if it is not much larger.
  if (10 * points.size() > 3 * all.size() || points.empty()) points = std::move(all);
  points.insert(points.end(), heads.begin(), heads.end());
  return points;
}

CameraView place_view(const SceneCloud& scene, const SceneLook& look, ScenePreset preset,
                      const std::vector<Vector3d>& points, double width, double height, double margin) {
  CameraView view;
  view.view_angle = radians(30);
  const double open_y = std::tan(view.view_angle / 2), pixel = 2 * open_y / height;
  const double room_x = std::max(width / 2 - margin, width / 10), room_y = std::max(height / 2 - margin, height / 10);
  FittingPosition fit;
  const auto look_down = [&](double angle_deg) {
    const ViewAxes axes = preset_axes(look, preset, angle_deg);
    fit = fitting_position(points, axes, room_x * pixel, room_y * pixel);
    return axes;
  };
  ViewAxes axes = look_down(shallow_deg);
  if (preset == ScenePreset::automatic && look.head) {
    // A picture as tall as wide stays half empty above a flat scene: look down more steeply until it is filled, and
    // show more of the scene behind.
    const auto filled = [&] {
      const HeightSpan span = height_span(points, axes, fit.at);
      return (span.high - span.low) / (2 * open_y);
    };
    for (double angle = shallow_deg; angle < steep_deg && filled() < 0.7;) axes = look_down(angle += 5);
    if (goes_on_above(scene, axes, fit.at, height_span(points, axes, fit.at).high)) fit.at += fit.slack_up * axes.up;
  }
  view.position = fit.at;
  double sum = 0;
  for (const Vector3d& point : points) sum += axes.forward.dot(point - view.position);
  view.focal_point = view.position + sum / static_cast<double>(points.size()) * axes.forward;
  view.up = axes.up;
  return view;
}

ShownPoint show_point(const CameraView& view, const Vector3d& point, double width, double height) {
  const ViewAxes axes = view_axes(view.forward(), view.up);
  const Vector3d from_eye = point - view.position;
  const double distance = axes.forward.dot(from_eye);
  const double scale = height / (2 * std::tan(view.view_angle / 2) * distance);
  return {{width / 2 + scale * axes.right.dot(from_eye), height / 2 + scale * axes.up.dot(from_eye)}, distance};
}

}  // namespace insonify
