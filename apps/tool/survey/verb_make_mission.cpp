// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "run/parse_values.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/open_scene.hpp"
#include "store/run_directory.hpp"
#include "store/sonar_file.hpp"
#include "store/toml_tree.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

struct MakeMissionOptions {
  CommonOptions common;
  std::string name, output, scene, sonar, range;
  std::string centre, size = "20,10";
  double spacing = 5, radius = 10, speed = 1, rate = 2, down_deg = 20;
  bool labels = false, force = false;
};

void add_options(OptionList list, MakeMissionOptions& o) {
  list.add("NAME", &o.name,
           "lawnmower: parallel lines; orbit: a circle, looking inwards; tunnel: a line, with a head that scans across",
           {.required = true, .words = {"lawnmower", "orbit", "tunnel"}});
  list.add("-o,--output", &o.output, "mission that is written, .toml", {.required = true});
  list.add("--scene", &o.scene, "scene of the survey", {.required = true});
  list.add("--sonar", &o.sonar, "preset or .toml file of the sonar; default: gemini-720im, or ping360 in a tunnel");
  list.add(
      "--range", &o.range,
      "min:max [m]; default: to the end of the scene from every place of the way, of a sounder at most 2.5 times the "
      "depth below it, at most to the sonar's greatest range");
  list.add("--centre", &o.centre,
           "x,y,z [m] of the middle of the way; default: over the middle of the scene, at z = -3 if the scene reaches "
           "below, else above it; of a scene that does not exist yet 0,0,-3");
  list.add("--size", &o.size, "x,y [m] extent of the lines; x is the length of a tunnel");
  list.add("--spacing", &o.spacing, "[m] distance between lines", {.positive = true});
  list.add("--radius", &o.radius, "[m] radius of the orbit", {.positive = true});
  list.add("--speed", &o.speed, "[m/s]", {.positive = true});
  list.add("--rate", &o.rate, "pings per second; a tunnel takes as many as the range allows", {.positive = true});
  list.add("--down", &o.down_deg, "[deg] tilt of the head; unused if the sonar's file gives the mounting");
  list.add("--labels", &o.labels, "store what every pixel shows, for insonify dataset");
  list.add("--force", &o.force, "replace an existing file");
  add_common(list, o.common);
}

std::string points_as_toml(const std::vector<Eigen::Vector3d>& points) {
  std::string text = "waypoints_m = [";
  for (const Eigen::Vector3d& p : points) text += fmt::format("\n  [{:.3f}, {:.3f}, {:.3f}],", p.x(), p.y(), p.z());
  return text + "\n]\n";
}

/// The points and keys in which the shapes of a mission differ.
struct MissionShape {
  std::vector<Eigen::Vector3d> points;
  double turn_radius = 1;
  std::string angles;  ///< key of [[head]]
  std::string head;    ///< further keys
  std::string legs;
};

/// Lines along x; the turns are half circles beyond the area, in transit.
MissionShape lawnmower(const MakeMissionOptions& o, const Eigen::Vector3d& centre, const std::vector<double>& size) {
  MissionShape shape;
  shape.turn_radius = o.spacing / 2;
  const int lines = static_cast<int>(std::floor(size[1] / o.spacing)) + 1;
  const double turn = pi * shape.turn_radius;
  for (int k = 0; k < lines; ++k) {
    const double y = o.spacing * (k - (lines - 1) / 2.0), side = k % 2 == 0 ? 1 : -1;
    const double begin = size[0] / 2 + (k > 0 ? shape.turn_radius : 0);
    const double end = size[0] / 2 + (k + 1 < lines ? shape.turn_radius : 0);
    shape.points.push_back(centre + Eigen::Vector3d(-side * begin, y, 0));
    shape.points.push_back(centre + Eigen::Vector3d(side * end, y, 0));
    const double from = k * (size[0] + turn) / o.speed;
    shape.legs += fmt::format("\n[[leg]]\nname = \"line-{}\"\nfrom_s = {:.4f}\n", k + 1, from);
    if (k + 1 < lines) shape.legs += fmt::format("to_s = {:.4f}\n", from + size[0] / o.speed);
  }
  shape.angles = fmt::format("pitch_deg = {:g}\n", -o.down_deg + 0.0);
  shape.head = fmt::format("rate_hz = {:g}\n", o.rate);
  return shape;
}

/// Once round to port, with the head to port: a polygon whose corners are blended into its inscribed circle.
MissionShape orbit(const MakeMissionOptions& o, const Eigen::Vector3d& centre) {
  MissionShape shape;
  shape.turn_radius = o.radius;
  constexpr int corners = 24;
  const double outside = o.radius / std::cos(pi / corners);
  shape.points.push_back(centre + Eigen::Vector3d(o.radius, 0, 0));
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * (k + 0.5) / corners;
    shape.points.push_back(centre + outside * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  shape.points.push_back(shape.points.front());
  shape.angles = fmt::format("heading_deg = -90\npitch_deg = {:g}\n", -o.down_deg + 0.0);
  shape.head = fmt::format("rate_hz = {:g}\n", o.rate);
  return shape;
}

/// Along x; the head lies on its back, so that it scans the plane across the way.
MissionShape tunnel(const Eigen::Vector3d& centre, const std::vector<double>& size) {
  const Eigen::Vector3d half(size[0] / 2, 0, 0);
  return {{centre - half, centre + half},
          1,
          "pitch_deg = -90\n",
          "\n[head.scan]\nstart_deg = 0\nstop_deg = 360\nstep_deg = 1.8\n",
          ""};
}

/// Returns true if a sonar is mounted to look down: a swath, or an echo sounder of one beam.
bool is_sounder(const SonarFile& sonar) { return sonar.mounting.x() == 0 && sonar.mounting.y() > radians(45); }

/// Returns a position over the middle of a scene [m].
Eigen::Vector3d centre_over(const std::optional<Bounds>& box) {
  constexpr double below_surface = -3;
  if (!box) return {0, 0, below_surface};
  const Eigen::Vector2d middle = (box->min + box->max).head<2>() / 2;
  const double over = height_over(*box);
  return {middle.x(), middle.y(), box->min.z() < below_surface && below_surface < over ? below_surface : over};
}

/// The range of a sonar that holds the scene from every point of the way; of a sounder not beyond the beams that see a
/// level bed, 66 degrees from the vertical.
std::string range_over(const Bounds& box, const SonarFile& file, const std::vector<Eigen::Vector3d>& way) {
  constexpr double depths = 2.5;
  const SonarSpec& sonar = file.spec;
  double reach = 0, deepest = 0;
  for (const Eigen::Vector3d& p : way)
    reach = std::max(reach, reach_of(box, p, {})), deepest = std::max(deepest, p.z() - box.min.z());
  if (is_sounder(file) && deepest > 0) reach = std::min(reach, depths * deepest);
  return range_text(sonar.min_range,
                    reach > sonar.min_range ? std::min(sonar.max_range, end_of_range(reach)) : sonar.max_range);
}

/// [ping]: of sounders the noise, above which the bottom is detected, of swaths the phase, by which it is; labels if
/// asked for, of sounders those of samples, since their soundings need samples.
std::string ping_as_toml(const MakeMissionOptions& o, const SonarFile& sonar) {
  std::string keys;
  if (is_sounder(sonar)) keys = "noise = true  # the soundings are those that stand above it\n";
  if (is_sounder(sonar) && sonar.spec.beams > 1)
    keys += "split = true  # for soundings: insonify export run --to csv, gsf, las or geotiff\n";
  if (o.labels)
    keys += fmt::format("keep = [\"{}\"]  # for labels: insonify dataset run\n",
                        is_sounder(sonar) ? "contributors" : "labels");
  return keys.empty() ? "" : "\n[ping]\n" + keys;
}

/// [[head]], or one for each side if the sonar is mounted to look to port.
std::string heads_as_toml(const std::string& sonar, const std::string& range, const Eigen::Vector3d& mounting,
                          const MissionShape& shape) {
  const auto head = [&](const char* name, const std::string& angles) {
    return fmt::format("\n[[head]]\nname = \"{}\"\nsonar = {}\n{}{}{}", name, as_toml(sonar),
                       range.empty() ? "" : "range = " + as_toml(range) + "\n", angles, shape.head);
  };
  if (mounting.x() != 0) return head("port", "") + head("starboard", "side = \"starboard\"\n");
  return head("sonar", mounting.isZero() ? shape.angles : "");
}

void make_mission(const MakeMissionOptions& o) {
  require_free_file(o.output, o.force, {o.scene, o.sonar});
  std::optional<Bounds> box;
  if (path_exists(o.scene) && (o.centre.empty() || o.range.empty())) box = box_of_scene(o.scene);
  const Eigen::Vector3d centre =
      o.centre.empty() ? centre_over(box) : parse_vector("--centre", o.centre, "x,y,z in metres");
  const auto size = parse_numbers("--size", o.size, 2, "two lengths in metres, e.g. --size 20,10");
  if (!(size[0] > 0 && size[1] >= 0)) fail(ErrorKind::argument, "--size = ", o.size, " must be two lengths in metres");
  const MissionShape shape = o.name == "lawnmower" ? lawnmower(o, centre, size)
                             : o.name == "orbit"   ? orbit(o, centre)
                                                   : tunnel(centre, size);
  const std::string sonar = !o.sonar.empty() ? o.sonar : o.name == "tunnel" ? "ping360" : "gemini-720im";
  const SonarFile file = find_sonar(sonar);
  std::string range = o.range;
  if (range.empty() && box) range = range_over(*box, file, shape.points);
  write_file(o.output,
             fmt::format("# {}; docs/reference/keys.md lists all keys.\nschema = 1\n\n[survey]\nscene = {}\nseed = "
                         "1\n\n[trajectory]\n{}speed_m_s = {:g}\nturn_radius_m = {:g}\n{}{}{}",
                         o.name, as_toml(o.scene), points_as_toml(shape.points), o.speed, shape.turn_radius,
                         heads_as_toml(sonar, range, file.mounting, shape), ping_as_toml(o, file), shape.legs));
  if (range.empty())
    Progress(o.common, 1)
        .note(o.scene +
              " does not exist yet, and the mission takes the sonar's own range; give --range to set another");
  print_summary(o.common, {{"output", o.output}, {"scene", o.scene}, {"sonar", sonar}},
                fmt::format("{}: run the mission with: insonify survey {} -o run", o.output, o.output));
}

}  // namespace

Verb make_mission_verb() {
  return make_verb<MakeMissionOptions>(
      "make-mission", "a mission file to begin with",
      {"insonify make-mission lawnmower --scene harbour.ply --range 0.5:15 -o mission.toml",
       "insonify make-mission orbit --scene harbour.ply --centre 12,0,-4 --radius 8 --range 0.5:15 -o orbit.toml"},
      add_options, make_mission);
}

}  // namespace insonify::tool
