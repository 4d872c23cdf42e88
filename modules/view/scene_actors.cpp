#include <algorithm>
#include <cmath>
#include <numeric>

#include <vtkProperty.h>

#include "view/canvas_internal.hpp"
#include "view/scene_actor_parts_internal.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/scene_surfels_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_moving = 200000;

Colour fan_colour(bool dark) { return dark ? Colour{0.42, 0.72, 1.0} : Colour{0.08, 0.38, 0.75}; }
constexpr Colour highlight_colour = {0.96, 0.05, 0.62};
constexpr std::array<Colour, 3> axis_colours = {{{0.86, 0.16, 0.14}, {0.16, 0.62, 0.2}, {0.16, 0.33, 0.9}}};

std::vector<std::uint32_t> counted(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

// Points of a single colour that share arrays with another actor.
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
constexpr double normal_length = 0.012;  // of the diagonal; or three spacings, if longer

Polyline normal_of(const SceneCloud& scene, std::uint32_t i, double least) {
  const Eigen::Vector3d place = scene.point[i].cast<double>();
  const Eigen::Vector3d tip =
      std::max(least, 3 * std::sqrt(static_cast<double>(scene.area[i]))) * scene.normal[i].cast<double>();
  return {scene.normals_oriented ? place : Eigen::Vector3d(place - tip), place + tip};
}

}  // namespace

void SceneActors::Parts::make_surfels() {
  const std::size_t most = look.most_surfels > 0 ? look.most_surfels : scene.size();
  drawn = drawn_surfels(scene, most);
  const std::vector<std::uint32_t> few = drawn_surfels(scene, std::min(most, most_moving));
  moving_drawn = few.size();
  surfels = point_arrays(scene.point, surfel_sides(scene));
  still = point_actor(surfels, drawn);
  moving = point_actor(surfels, few);
  moving->VisibilityOff();
  const Colour blue = fan_colour(options.dark);
  footprint = plain_points(surfels, blue, 2.5 * thin(), 0.004);
  marks = plain_points(surfels, highlight_colour, 6 * thin(), 1);
  soundings = point_actor(sounding_arrays = point_arrays({}, {}), {});
  mapper_of(soundings)->min_pixels = 3 * thin();
  mapper_of(soundings)->lift = 0.006;
  grow();
}

void SceneActors::Parts::make_lines() {
  const Colour blue = fan_colour(options.dark), line = theme(options.dark).line;
  outline = line_actor(blue, 1.3 * thin());
  arcs = line_actor(blue, 0.8 * thin());
  beams = line_actor(blue, 0.8 * thin());
  for (std::size_t i = 0; i < 3; ++i) head_axes[i] = line_actor(axis_colours[i], 2.5 * thin());
  body = body_actor();
  floor = line_actor(line, thin());
  grid = line_actor(line, 0.6 * thin());
  grid->GetProperty()->SetOpacity(0.4);
}

void SceneActors::Parts::colour() {
  SceneColours colours = colour_surfels(scene, look, options, who);
  key = std::move(colours.key);
  if (look.colour == SceneColour::visibility && !look.holes.empty())
    key.legend.push_back({"hole of the scan", hole_rgb});
  set_colours(surfels.colours, colours.colour);
}

// Enlarges thinned surfels so that they cover the area of all.
void SceneActors::Parts::grow() {
  const auto growth = [&](std::size_t count) {
    return look.point_size * std::sqrt(static_cast<double>(scene.size()) / static_cast<double>(count));
  };
  mapper_of(still)->growth = growth(drawn.size());
  mapper_of(moving)->growth = growth(moving_drawn);
  mapper_of(footprint)->growth = mapper_of(marks)->growth = look.point_size;
}

SceneActors::SceneActors(const SceneCloud& scene, SceneLook look, const PictureOptions& options, const char* who) {
  require_drawable(scene, look, who);
  parts_ = std::make_unique<Parts>(scene, std::move(look), options, who);
  Parts& p = *parts_;
  p.make_surfels();
  p.make_lines();
  p.make_marks();
  p.colour();
  p.look_again();
  p.axes_shown = p.look.axes;
  if (p.look.head) show_head(p.look.head->world_from_head, p.look.head->fan, p.look.head->gate);
  highlight(std::vector<std::uint32_t>(p.look.highlighted));
  show_soundings(Soundings(p.look.soundings));
  show_holes(std::vector<Eigen::Vector3d>(p.look.holes));
  show_normals(p.look.normals);
}

SceneActors::~SceneActors() = default;

void SceneActors::add_to(vtkRenderer* renderer) {
  for (vtkActor* actor : parts_->actors()) renderer->AddActor(actor);
}

void SceneActors::set_colour(SceneColour colour) {
  const SceneColour before = std::exchange(parts_->look.colour, colour);
  try {
    parts_->colour();
  } catch (...) {
    parts_->look.colour = before;
    throw;
  }
}

void SceneActors::set_visibility(std::vector<Visibility> visibility) {
  require_length(visibility.size(), parts_->scene, "visibility", parts_->who);
  parts_->look.visibility = std::move(visibility);
  if (parts_->look.colour == SceneColour::visibility && !parts_->look.visibility.empty()) parts_->colour();
}

void SceneActors::set_level_range(double min_db, double max_db) {
  parts_->options.min_db = min_db;
  parts_->options.max_db = max_db;
  if (parts_->look.colour == SceneColour::level) parts_->colour();
  show_soundings(Soundings(parts_->look.soundings));
}

void SceneActors::set_colour_map(const std::string& name) {
  colour_table(name, parts_->who);
  parts_->options.colour_map = name;
  set_level_range(parts_->options.min_db, parts_->options.max_db);
}

void SceneActors::highlight(std::span<const std::uint32_t> surfels) {
  require_surfels(surfels, parts_->scene, parts_->who);
  set_points(parts_->marks, parts_->surfels, surfels);
  parts_->look.highlighted.assign(surfels.begin(), surfels.end());
}

void SceneActors::show_soundings(const Soundings& soundings) {
  Parts& p = *parts_;
  require_valid(soundings, p.who);
  p.look.soundings = soundings;
  p.sounding_places.clear();
  std::vector<Rgb> colour;
  if (soundings.size() > 0) {
    const ColourScale scale = level_scale(p.look, p.options, p.who);
    for (std::size_t i = 0; i < soundings.size(); ++i) {
      p.sounding_places.push_back((soundings.position[i] - p.scene.origin).cast<float>());
      colour.push_back(scale.colour(soundings.level_db[i]));
    }
  }
  p.sounding_arrays = point_arrays(p.sounding_places, std::vector<float>(soundings.size()));
  set_colours(p.sounding_arrays.colours, colour);
  set_points(p.soundings, p.sounding_arrays, counted(soundings.size()));
  if (p.look.colour == SceneColour::level && !p.look.level_db.empty())
    p.colour();  // surfels and soundings share one scale
}

void SceneActors::show_head(const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate) {
  Parts& p = *parts_;
  const SceneHead head{world_from_head, fan, gate};
  require_valid(head, p.who);
  p.look.head = head;
  p.look_again();
  const double size = 0.022 * std::min(gate.max_range, p.box().diagonal().norm());
  const HeadLines lines = head_lines(head, p.scene.origin, size);
  set_lines(p.outline, lines.outline);
  set_lines(p.arcs, lines.arcs);
  set_lines(p.beams, lines.beams);
  for (std::size_t i = 0; i < 3; ++i) set_lines(p.head_axes[i], {lines.axes[i]});
  set_body(p.body, lines.body_rings);
  set_points(p.footprint, p.surfels, footprint_outline(p.scene, head));
  if (p.look.colour == SceneColour::grazing || p.look.colour == SceneColour::incidence) p.colour();
}

void SceneActors::Parts::make_marks() {
  holes = point_actor(hole_arrays = point_arrays({}, {}), {});
  holes->GetMapper()->ScalarVisibilityOff();
  holes->GetProperty()->SetColor(hole_rgb[0] / 255.0, hole_rgb[1] / 255.0, hole_rgb[2] / 255.0);
  mapper_of(holes)->min_pixels = 3 * thin();
  mapper_of(holes)->lift = 0.008;
  normals = line_actor(options.dark ? Colour{0.5, 0.9, 0.6} : Colour{0.1, 0.45, 0.2}, 0.8 * thin());
}

void SceneActors::show_holes(const std::vector<Eigen::Vector3d>& places) {
  Parts& p = *parts_;
  p.hole_places.clear();
  for (const Eigen::Vector3d& place : places) p.hole_places.push_back((place - p.scene.origin).cast<float>());
  p.look.holes = places;
  p.hole_arrays = point_arrays(p.hole_places, std::vector<float>(places.size()));
  set_points(p.holes, p.hole_arrays, counted(places.size()));
  if (p.look.colour == SceneColour::visibility) p.colour();  // the legend names them
}

void SceneActors::show_normals(bool on) {
  Parts& p = *parts_;
  p.look.normals = on;
  std::vector<Polyline> lines;
  const double least = normal_length * p.box().diagonal().norm();
  if (on)
    for (const std::uint32_t i : drawn_surfels(p.scene, std::min(most_normals, p.scene.size())))
      lines.push_back(normal_of(p.scene, i, least));
  set_lines(p.normals, lines);
}

void SceneActors::set_detail(SceneDetail detail) {
  parts_->still->SetVisibility(detail == SceneDetail::still);
  parts_->moving->SetVisibility(detail == SceneDetail::moving);
}

void SceneActors::set_point_size(double point_size) {
  require_point_size(point_size, parts_->who);
  parts_->look.point_size = point_size;
  parts_->grow();
}

double SceneActors::point_size() const { return parts_->look.point_size; }

const SceneLook& SceneActors::look() const { return parts_->look; }
const SceneKey& SceneActors::key() const { return parts_->key; }

std::optional<SceneKey> SceneActors::soundings_key() const {
  const Parts& p = *parts_;
  const bool shared = p.look.colour == SceneColour::level && !p.look.level_db.empty();
  if (p.look.soundings.size() == 0 || shared) return {};
  return SceneKey{level_scale(p.look, p.options, p.who), p.look.level_unit, {}};
}

}  // namespace insonify
