// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include <vtkProperty.h>

#include "view/canvas_internal.hpp"
#include "view/scene_actors_internal.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/scene_surfels_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_moving = 200000;

Colour fan_colour(bool dark) { return dark ? Colour{0.42, 0.72, 1.0} : Colour{0.08, 0.38, 0.75}; }
constexpr Colour track_colour = {0.95, 0.5, 0.05};
constexpr Colour highlight_colour = {0.96, 0.05, 0.62};
constexpr std::array<Colour, 3> axis_colours = {{{0.86, 0.16, 0.14}, {0.16, 0.62, 0.2}, {0.16, 0.33, 0.9}}};

std::vector<std::uint32_t> counted(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

vtkSmartPointer<vtkActor> plain_points(const PointCloudArrays& arrays, const Colour& colour, double min_pixels,
                                       double lift) {
  vtkSmartPointer<vtkActor> actor = point_actor(arrays, {});
  actor->GetMapper()->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  mapper_of(actor)->min_pixels = min_pixels;
  mapper_of(actor)->lift = lift;
  return actor;
}

constexpr std::size_t most_normals = 4000;
constexpr double normal_length = 0.012;  // fraction of the diagonal; or three spacings, if longer

Polyline normal_of(const SceneCloud& scene, std::uint32_t i, double least) {
  const Eigen::Vector3d position = scene.point[i].cast<double>();
  const Eigen::Vector3d tip =
      std::max(least, 3 * std::sqrt(static_cast<double>(scene.area[i]))) * scene.normal[i].cast<double>();
  return {scene.normals_oriented ? position : Eigen::Vector3d(position - tip), position + tip};
}

}  // namespace

void SceneActors::make_surfels() {
  const std::size_t most = look_.most_surfels > 0 ? look_.most_surfels : scene_.size();
  drawn_ = drawn_surfels(scene_, most);
  const std::vector<std::uint32_t> few = drawn_surfels(scene_, std::min(most, most_moving));
  moving_drawn_ = few.size();
  surfels_ = point_arrays(scene_.point, surfel_sides(scene_));
  still_ = point_actor(surfels_, drawn_);
  moving_ = point_actor(surfels_, few);
  moving_->VisibilityOff();
  const Colour blue = fan_colour(options_.dark);
  footprint_ = plain_points(surfels_, blue, 2.5 * thin(), 0.004);
  marks_ = plain_points(surfels_, highlight_colour, 6 * thin(), 1);
  soundings_ = point_actor(sounding_arrays_ = point_arrays({}, {}), {});
  mapper_of(soundings_)->min_pixels = 3 * thin();
  mapper_of(soundings_)->lift = 0.006;
  grow();
}

void SceneActors::make_lines() {
  const Colour blue = fan_colour(options_.dark), line = theme(options_.dark).line;
  outline_ = line_actor(blue, 1.3 * thin());
  track_ = line_actor(track_colour, 2 * thin());
  if (look_.track.size() > 1) {
    Polyline way = look_.track;
    for (Eigen::Vector3d& position : way) position -= scene_.origin;
    set_lines(track_, {way});
  }
  arcs_ = line_actor(blue, 0.8 * thin());
  beams_ = line_actor(blue, 0.8 * thin());
  for (std::size_t i = 0; i < 3; ++i) head_axes_[i] = line_actor(axis_colours[i], 2.5 * thin());
  body_ = body_actor();
  floor_ = line_actor(line, thin());
  grid_ = line_actor(line, 0.6 * thin());
  grid_->GetProperty()->SetOpacity(0.4);
}

void SceneActors::recolour() {
  SceneColours colours = colour_surfels(scene_, look_, options_, who_);
  key_ = std::move(colours.key);
  if (look_.colour == SceneColour::visibility && !look_.holes.empty())
    key_.legend.push_back({"hole of the scan", hole_rgb});
  set_colours(surfels_.colours, colours.colour);
}

// Enlarges thinned surfels so that they cover the area of all.
void SceneActors::grow() {
  const auto growth = [&](std::size_t count) {
    return look_.point_size * std::sqrt(static_cast<double>(scene_.size()) / static_cast<double>(count));
  };
  mapper_of(still_)->growth = growth(drawn_.size());
  mapper_of(moving_)->growth = growth(moving_drawn_);
  mapper_of(footprint_)->growth = mapper_of(marks_)->growth = look_.point_size;
}

SceneActors::SceneActors(const SceneCloud& scene, SceneLook look, const PictureOptions& options, const char* who)
    : scene_(scene), look_(std::move(look)), options_(options), who_(who) {
  require_drawable(scene_, look_, who_);
  make_surfels();
  make_lines();
  make_marks();
  recolour();
  look_again();
  axes_shown_ = look_.axes;
  if (look_.head) show_head(look_.head->world_from_head, look_.head->fan, look_.head->gate);
  highlight(std::vector<std::uint32_t>(look_.highlighted));
  show_soundings(Soundings(look_.soundings));
  show_holes(std::vector<Eigen::Vector3d>(look_.holes));
  show_normals(look_.normals);
}

std::vector<LegendEntry> SceneActors::line_key() const {
  const auto rgb = [](const Colour& colour) {
    Rgb bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(std::lround(255 * colour[i]));
    return bytes;
  };
  std::vector<LegendEntry> key;
  if (look_.head) key.push_back({"fan, footprint", rgb(fan_colour(options_.dark))});
  if (look_.track.size() > 1) key.push_back({"way of the head", rgb(track_colour)});
  return key;
}

void SceneActors::add_to(vtkRenderer* renderer) {
  for (vtkActor* actor : actors()) renderer->AddActor(actor);
}

void SceneActors::remove_from(vtkRenderer* renderer) {
  for (vtkActor* actor : actors()) renderer->RemoveActor(actor);
  for (const auto& label : labels_) renderer->RemoveActor2D(label);
  labels_.clear();
}

void SceneActors::set_colour(SceneColour colour) {
  const SceneColour before = std::exchange(look_.colour, colour);
  try {
    recolour();
  } catch (...) {
    look_.colour = before;
    throw;
  }
}

void SceneActors::set_visibility(std::vector<Visibility> visibility) {
  require_length(visibility.size(), scene_, "visibility", who_);
  look_.visibility = std::move(visibility);
  if (look_.colour == SceneColour::visibility && !look_.visibility.empty()) recolour();
}

void SceneActors::set_level_range(double min_db, double max_db) {
  options_.min_db = min_db;
  options_.max_db = max_db;
  if (look_.colour == SceneColour::level) recolour();
  show_soundings(Soundings(look_.soundings));
}

void SceneActors::set_colour_map(const std::string& name) {
  colour_table(name, who_);
  options_.colour_map = name;
  set_level_range(options_.min_db, options_.max_db);
}

void SceneActors::highlight(std::span<const std::uint32_t> surfels) {
  require_surfels(surfels, scene_, who_);
  set_points(marks_, surfels_, surfels);
  look_.highlighted.assign(surfels.begin(), surfels.end());
}

void SceneActors::show_soundings(const Soundings& soundings) {
  require_valid(soundings, who_);
  look_.soundings = soundings;
  sounding_positions_.clear();
  std::vector<Rgb> colour;
  if (soundings.size() > 0) {
    const ColourScale scale = level_scale(look_, options_, who_);
    for (std::size_t i = 0; i < soundings.size(); ++i) {
      sounding_positions_.push_back((soundings.position[i] - scene_.origin).cast<float>());
      colour.push_back(scale.colour(soundings.level_db[i]));
    }
  }
  sounding_arrays_ = point_arrays(sounding_positions_, std::vector<float>(soundings.size()));
  set_colours(sounding_arrays_.colours, colour);
  set_points(soundings_, sounding_arrays_, counted(soundings.size()));
  if (look_.colour == SceneColour::level && !look_.level_db.empty())
    recolour();  // surfels and soundings share one scale
}

void SceneActors::show_head(const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate) {
  const SceneHead head{world_from_head, fan, gate};
  require_valid(head, who_);
  look_.head = head;
  look_again();
  const double size = 0.022 * std::min(gate.max_range, box().diagonal().norm());
  const HeadLines lines = head_lines(head, scene_.origin, size);
  set_lines(outline_, lines.outline);
  set_lines(arcs_, lines.arcs);
  set_lines(beams_, lines.beams);
  for (std::size_t i = 0; i < 3; ++i) set_lines(head_axes_[i], {lines.axes[i]});
  set_body(body_, lines.body_rings);
  set_points(footprint_, surfels_, footprint_outline(scene_, head));
  if (look_.colour == SceneColour::grazing || look_.colour == SceneColour::incidence) recolour();
}

void SceneActors::make_marks() {
  holes_ = plain_points(hole_arrays_ = point_arrays({}, {}), shares_of(hole_rgb), 3 * thin(), 0.008);
  normals_ = line_actor(options_.dark ? Colour{0.5, 0.9, 0.6} : Colour{0.1, 0.45, 0.2}, 0.8 * thin());
}

void SceneActors::show_holes(const std::vector<Eigen::Vector3d>& positions) {
  hole_positions_.clear();
  for (const Eigen::Vector3d& position : positions) hole_positions_.push_back((position - scene_.origin).cast<float>());
  look_.holes = positions;
  hole_arrays_ = point_arrays(hole_positions_, std::vector<float>(positions.size()));
  set_points(holes_, hole_arrays_, counted(positions.size()));
  if (look_.colour == SceneColour::visibility) recolour();  // the legend names them
}

void SceneActors::show_normals(bool on) {
  look_.normals = on;
  std::vector<Polyline> lines;
  const double least = normal_length * box().diagonal().norm();
  if (on)
    for (const std::uint32_t i : drawn_surfels(scene_, std::min(most_normals, scene_.size())))
      lines.push_back(normal_of(scene_, i, least));
  set_lines(normals_, lines);
}

void SceneActors::set_detail(SceneDetail detail) {
  still_->SetVisibility(detail == SceneDetail::still);
  moving_->SetVisibility(detail == SceneDetail::moving);
}

void SceneActors::set_point_size(double point_size) {
  require_point_size(point_size, who_);
  look_.point_size = point_size;
  grow();
}

std::optional<SceneKey> SceneActors::soundings_key() const {
  const bool shared = look_.colour == SceneColour::level && !look_.level_db.empty();
  if (look_.soundings.size() == 0 || shared) return {};
  return SceneKey{level_scale(look_, options_, who_), look_.level_unit, {}};
}

}  // namespace insonify
