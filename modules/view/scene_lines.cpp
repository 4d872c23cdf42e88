// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "view/axes_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/scene_lines_internal.hpp"

namespace insonify {
namespace {

vtkIdType add_points(vtkPoints* points, const Polyline& line) {
  const vtkIdType first = points->GetNumberOfPoints();
  for (const Eigen::Vector3d& position : line) points->InsertNextPoint(position.data());
  return first;
}

void show(vtkActor* actor, vtkPolyData* shape) {
  static_cast<vtkPolyDataMapper*>(actor->GetMapper())->SetInputData(shape);
}

vtkSmartPointer<vtkActor> empty_actor() {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkPolyData> nothing;
  mapper->SetInputData(nothing);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

constexpr double largest_step = 0.035;  // [rad] between points of an arc
constexpr std::size_t most_rows = 5;
constexpr int ring_corners = 20;

// Returns angles from low to high, close enough for a smooth arc.
std::vector<double> steps_between(double low, double high) {
  const int steps = std::max(1, static_cast<int>(std::ceil((high - low) / largest_step)));
  std::vector<double> angles;
  for (int i = 0; i <= steps; ++i) angles.push_back(low + (high - low) * i / steps);
  return angles;
}

// Converts directions and ranges in head axes to positions in the scene.
class Placer {
 public:
  Placer(const SceneHead& head, const Eigen::Vector3d& origin)
      : turn_(head.world_from_head.linear()), at_(head.world_from_head.translation() - origin) {}

  Eigen::Vector3d position(const Eigen::Vector3d& in_head) const { return turn_ * in_head + at_; }
  Eigen::Vector3d position(double azimuth, double elevation, double range) const {
    return position(range * unit_vector({azimuth, elevation}));
  }
  Polyline across(const FanSector& sector, double elevation, double range) const {
    Polyline line;
    for (const double azimuth : steps_between(sector.low_azimuth, sector.high_azimuth))
      line.push_back(position(azimuth, elevation, range));
    return line;
  }
  Polyline upwards(double azimuth, const FanSector& sector, double range) const {
    Polyline line;
    for (const double elevation : steps_between(sector.low_elevation, sector.high_elevation))
      line.push_back(position(azimuth, elevation, range));
    return line;
  }
  Polyline ray(double azimuth, double elevation, const RangeGate& gate) const {
    return {position(azimuth, elevation, gate.min_range), position(azimuth, elevation, gate.max_range)};
  }

 private:
  Eigen::Matrix3d turn_;
  Eigen::Vector3d at_;
};

// Returns the angle plus whole turns, within half a turn of `middle`.
double unwrapped(double angle, double middle) { return middle + std::remainder(angle - middle, 2 * pi); }

}  // namespace

vtkSmartPointer<vtkPolyData> polylines(const std::vector<Polyline>& lines, int coordinates) {
  vtkNew<vtkPoints> points;
  points->SetDataType(coordinates);
  vtkNew<vtkCellArray> cells;
  for (const Polyline& line : lines) {
    const vtkIdType first = add_points(points, line);
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) cells->InsertCellPoint(first + static_cast<vtkIdType>(i));
  }
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetLines(cells);
  return shape;
}

vtkSmartPointer<vtkActor> line_actor(const Colour& colour, double width) {
  vtkSmartPointer<vtkActor> actor = empty_actor();
  vtkProperty* property = actor->GetProperty();
  property->LightingOff();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetLineWidth(static_cast<float>(width));
  return actor;
}

void set_lines(vtkActor* actor, const std::vector<Polyline>& lines) { show(actor, polylines(lines, VTK_FLOAT)); }

vtkSmartPointer<vtkActor> body_actor() {
  vtkSmartPointer<vtkActor> actor = empty_actor();
  actor->GetProperty()->SetColor(0.98, 0.62, 0.1);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.8);
  actor->GetProperty()->SetInterpolationToFlat();
  return actor;
}

void set_body(vtkActor* actor, const std::array<Polyline, 2>& rings) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  const auto corners = static_cast<vtkIdType>(rings[0].size());
  for (const Polyline& ring : rings) {
    const vtkIdType first = add_points(points, ring);
    faces->InsertNextCell(static_cast<int>(corners));
    for (vtkIdType i = 0; i < corners; ++i) faces->InsertCellPoint(first + i);
  }
  for (vtkIdType i = 0; i < corners; ++i) {
    const vtkIdType next = (i + 1) % corners;
    faces->InsertNextCell({i, next, corners + next, corners + i});
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  if (corners > 0) shape->SetPolys(faces);
  show(actor, shape);
}

FanSector fan_sector(const BeamFan& fan) {
  // Order the beams as in a fan picture; bearings have the opposite sign of azimuths.
  const BeamCells cells =
      order_beams({fan, {1, 2, 1}, Grid<float>::Zero(static_cast<Eigen::Index>(fan.beams()), 1), ""});
  FanSector sector;
  sector.low_azimuth = -cells.high();
  sector.high_azimuth = -cells.low();
  sector.full_circle = cells.high() - cells.low() > 2 * pi - std::max(1e-6, 0.5 * cells.mean_width());
  const double middle = (sector.low_azimuth + sector.high_azimuth) / 2;
  sector.first_azimuth = 1e300, sector.last_azimuth = -1e300;
  for (const double azimuth : fan.azimuth) {
    sector.first_azimuth = std::min(sector.first_azimuth, unwrapped(azimuth, middle));
    sector.last_azimuth = std::max(sector.last_azimuth, unwrapped(azimuth, middle));
  }

  std::vector<double> rows = fan.elevation;
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  sector.low_elevation = std::max(-pi / 2, rows.front() - fan.elevation_width / 2);
  sector.high_elevation = std::min(pi / 2, rows.back() + fan.elevation_width / 2);
  const std::size_t shown = std::min(rows.size(), most_rows);
  for (std::size_t i = 0; i < shown; ++i)
    sector.rows.push_back(rows[shown < 2 ? 0 : i * (rows.size() - 1) / (shown - 1)]);
  return sector;
}

std::vector<FanSector> fan_sectors(const BeamFan& fan) {
  constexpr double apart = 8;  // beam widths between two beams that are the sides of a side-scan
  const bool sides =
      fan.beams() == 2 && std::abs(std::remainder(fan.azimuth[1] - fan.azimuth[0], 2 * pi)) > apart * fan.beam_width;
  if (!sides) return {fan_sector(fan)};
  std::vector<FanSector> sectors;
  for (std::size_t b = 0; b < 2; ++b) {
    BeamFan side = fan;
    side.azimuth = {fan.azimuth[b]}, side.elevation = {fan.elevation[b]};
    sectors.push_back(fan_sector(side));
  }
  return sectors;
}

namespace {

void add_sector(const FanSector& sector, const RangeGate& gate, const Placer& at, HeadLines& lines) {
  for (const double range : {gate.min_range, gate.max_range}) {
    for (const double elevation : {sector.low_elevation, sector.high_elevation})
      lines.outline.push_back(at.across(sector, elevation, range));
    if (!sector.full_circle)
      for (const double azimuth : {sector.low_azimuth, sector.high_azimuth})
        lines.outline.push_back(at.upwards(azimuth, sector, range));
  }
  if (!sector.full_circle)
    for (const double azimuth : {sector.low_azimuth, sector.high_azimuth})
      for (const double elevation : {sector.low_elevation, sector.high_elevation})
        lines.outline.push_back(at.ray(azimuth, elevation, gate));

  // Draw arcs in the plane of the fan; with several rows only the last arc of each.
  const double step = round_step(gate.max_range / 4);
  for (const double elevation : sector.rows) {
    lines.arcs.push_back(at.across(sector, elevation, gate.max_range));
    if (sector.full_circle) continue;  // its first and last beams are adjacent
    lines.beams.push_back(at.ray(sector.first_azimuth, elevation, gate));
    lines.beams.push_back(at.ray(sector.last_azimuth, elevation, gate));
  }
  for (const double range : multiples(step, gate.min_range, 0.99 * gate.max_range))
    lines.arcs.push_back(at.across(sector, sector.rows[sector.rows.size() / 2], range));
}

// Returns how far a place in head axes [m] is inside of the walls of a sector; negative outside.
double inside_of(const FanSector& sector, const RangeGate& gate, const Eigen::Vector3d& place) {
  const double range = place.norm(), middle = (sector.low_azimuth + sector.high_azimuth) / 2;
  const double half_azimuth = (sector.high_azimuth - sector.low_azimuth) / 2;
  const Direction towards = direction_of(place);
  const double turned = std::abs(unwrapped(towards.azimuth, middle) - middle);
  const double level_range = range * std::cos(towards.elevation);
  const double inside_sides = sector.full_circle ? 1e300 : level_range * (half_azimuth - turned);
  const double inside_rows = range * std::min(towards.elevation - sector.low_elevation,  //
                                              sector.high_elevation - towards.elevation);
  return std::min({inside_sides, inside_rows, range - gate.min_range, gate.max_range - range});
}

}  // namespace

HeadLines head_lines(const SceneHead& head, const Eigen::Vector3d& scene_origin, double size) {
  const Placer at(head, scene_origin);
  HeadLines lines;
  for (const FanSector& sector : fan_sectors(head.fan)) add_sector(sector, head.gate, at, lines);
  for (int i = 0; i < 3; ++i)
    lines.axes[static_cast<std::size_t>(i)] = {at.position(Eigen::Vector3d::Zero()),
                                               at.position(2 * size * Eigen::Vector3d::Unit(i))};
  for (int i = 0; i < ring_corners; ++i) {
    const double angle = 2 * pi * i / ring_corners, y = std::cos(angle), z = std::sin(angle);
    lines.body_rings[0].push_back(at.position(size * Eigen::Vector3d(-1, 0.3 * y, 0.3 * z)));
    lines.body_rings[1].push_back(at.position(size * Eigen::Vector3d(0.1, 0.42 * y, 0.42 * z)));
  }
  return lines;
}

std::vector<std::uint32_t> footprint_outline(const SceneCloud& scene, const SceneHead& head) {
  const std::vector<FanSector> sectors = fan_sectors(head.fan);
  const Eigen::Isometry3d head_from_world = head.world_from_head.inverse();

  // Measure the distance of a surfel inside each pair of walls [m]. On the outline it is small for one pair.
  const auto on_outline = [&](std::size_t i) {
    const Eigen::Vector3d normal = scene.normal[i].cast<double>();
    const Eigen::Vector3d position = head_from_world * (scene.origin + scene.point[i].cast<double>());
    const double range = position.norm(), reach = 0.7 * std::sqrt(static_cast<double>(scene.area[i]));
    if (!(range > 0) || range > head.gate.max_range + reach) return false;
    if (scene.normals_oriented && (head_from_world.linear() * normal).dot(position) > 0) return false;
    return std::any_of(sectors.begin(), sectors.end(), [&](const FanSector& sector) {
      return std::abs(inside_of(sector, head.gate, position)) <= reach;
    });
  };

  std::vector<std::uint8_t> marked(scene.size());
  parallel_blocks(scene.size(), 1 << 16, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) marked[i] = on_outline(i);
  });
  std::vector<std::uint32_t> outline;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i]) outline.push_back(static_cast<std::uint32_t>(i));
  return outline;
}

}  // namespace insonify
