// SPDX-License-Identifier: BSD-3-Clause
// Expected levels and visibility of whole pings of rough ground against its triangles: facet by facet, every line of
// sight walked over the triangles without a step.
//
//   exact_height_field                                  generated beds, clouds drawn from them in several ways
//   exact_height_field CLOUD SONAR X Y Z YAW PITCH ROLL MIN_RANGE MAX_RANGE
//                                                       a captured raster (metres, degrees), SONAR a file or preset
//
// A row each: error of the total, of the worst of nine bands of range, and of cells of two beams by 0.2 m within 20 dB
// of the strongest [dB]; energy of surfels hidden and shown wrongly by the true line of sight to their centres, and the
// worst difference of both in a band [% of what is to be seen].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/sonar_file.hpp"
#include "support/height_field.hpp"
#include "support/rough_field.hpp"
#include "support/scene_for_ping.hpp"
#include "tiles/tile_writer.hpp"

using namespace insonify;

namespace {

constexpr Eigen::Index bands = 9, per_band = 5, cells = bands * per_band;

struct View {
  SonarHead head;
  Pose pose;
};

HeightField field_of(const SceneCloud& scene) {
  const Bounds box = bounds(scene);
  const Eigen::Vector3d size = box.max - box.min;
  HeightField field;
  field.corner = box.min.head<2>();
  // Nodes fill the box, unless some are missing.
  field.spacing = (std::sqrt(size.x() * size.y() * static_cast<double>(scene.size())) + (size.x() + size.y()) / 2) /
                  static_cast<double>(scene.size());
  const auto nodes = [&](double length) { return static_cast<Eigen::Index>(std::lround(length / field.spacing)) + 1; };
  field.spacing = size.x() / static_cast<double>(nodes(size.x()) - 1);
  field.z = Grid<double>::Constant(nodes(size.y()), nodes(size.x()), std::numeric_limits<double>::quiet_NaN());
  for (const Eigen::Vector3f& point : scene.point) {
    const Eigen::Vector3d p = scene.origin + point.cast<double>();
    const Eigen::Vector2d at = (p.head<2>() - field.corner) / field.spacing;
    field.z(std::lround(at.y()), std::lround(at.x())) = p.z();
  }
  std::printf("%ld x %ld nodes, %.4f m apart, %ld without a point\n", static_cast<long>(field.z.rows()),
              static_cast<long>(field.z.cols()), field.spacing, static_cast<long>(field.z.isNaN().count()));
  return field;
}

Grid<double> by_band(const Grid<double>& energy) {
  Grid<double> sums(1, bands);
  for (Eigen::Index b = 0; b < bands; ++b) sums(b) = energy.middleCols(b * per_band, per_band).sum();
  return sums;
}

double error_db(double a, double b) { return b > 0 ? db_from_power(a / b) : 0; }

// Surfels wrongly hidden and shown, by band, as fractions of the visible energy.
struct Wrong {
  Grid<double> hidden = Grid<double>::Zero(1, bands), shown = hidden, seen = hidden;
};

Wrong compare_surfels(const HeightField& field, const SceneCloud& scene, const View& view, SimulationOptions options) {
  options.sampling.scatterers_per_cell = 0;
  ResolvedPing ping = resolve_ping(whole_of(scene), view.head, {view.pose}, {}, options);
  const auto sampled = [&](bool occlusion) {
    SamplingOptions sampling = ping.view.sampling;
    sampling.occlusion = occlusion;
    return find_scatterers(scene, ping.view.world_from_head, ping.view.fan, view.head.gate, sampling).scatterers;
  };
  const Scatterers all = sampled(false), seen = sampled(true);
  std::vector<double> share(scene.size(), 0);
  for (std::size_t i = 0; i < seen.size(); ++i) share[seen.surfel[i]] = seen.projected_area[i];
  const Medium medium = medium_of(Water{}, view.head.pulse.centre_frequency);
  Wrong wrong;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(all.projected_area[i] > 0) || all.range[i] < view.head.gate.min_range) continue;
    Eigen::Vector3d position = scene.origin + scene.point[all.surfel[i]].cast<double>();
    position.z() = field.at(position.head<2>());
    const double energy =
        heard_by_definition(all.range[i] * unit_vector({all.azimuth[i], all.elevation[i]}), all.cos_incidence[i],
                            all.projected_area[i] / all.cos_incidence[i], 0.01, view.head, medium);
    const bool open = std::isfinite(position.z()) && field.in_view(position, view.pose.translation());
    const double part = share[all.surfel[i]] / all.projected_area[i];
    const double length = view.head.gate.max_range - view.head.gate.min_range;
    const auto band = std::min(bands - 1, static_cast<Eigen::Index>((all.range[i] - view.head.gate.min_range) / length *
                                                                    static_cast<double>(bands)));
    wrong.seen(band) += open ? energy : 0;
    (open ? wrong.hidden : wrong.shown)(band) += energy * (open ? 1 - part : part);
  }
  return wrong;
}

void print_row(const std::string& name, const HeightField& field, const Grid<double>& truth, const LoadedScene& loaded,
               const View& view, SamplingKind kind) {
  SimulationOptions options;
  options.synthesis.method = SynthesisMethod::incoherent;
  options.sampling.kind = kind;
  options.sampling.rays_per_beam = 1024;
  const SceneCloud scene = scene_for_ping(loaded, view.head, view.pose, options);
  const auto groups = truth.rows();
  const Grid<double> energy =
      energy_of(simulate_ping(scene, view.head, view.pose, {}, options).ping.pressure, groups, cells);
  const Grid<double> found = by_band(energy), wanted = by_band(truth);
  double worst = 0, squares = 0;
  std::string all;
  for (Eigen::Index b = 0; b < bands; ++b) {
    if (!(wanted(b) > 1e-6 * wanted.maxCoeff())) continue;
    const double error = error_db(found(b), wanted(b));
    if (std::abs(error) > std::abs(worst)) worst = error;
    char text[16];
    std::snprintf(text, sizeof text, " %+.2f", error);
    all += text;
  }
  Eigen::Index strong = 0;
  for (Eigen::Index i = 0; i < truth.size(); ++i)
    if (truth(i) > 0.01 * truth.maxCoeff())
      squares += std::pow(std::clamp(error_db(energy(i), truth(i)), -30.0, 30.0), 2), ++strong;
  std::printf("| %s | %+.3f | %+.2f |%s | %.2f |", name.c_str(), error_db(energy.sum(), truth.sum()), worst,
              all.c_str(), std::sqrt(squares / static_cast<double>(std::max<Eigen::Index>(strong, 1))));
  if (kind == SamplingKind::rays) {
    std::printf(" | |\n");
  } else {
    const Wrong wrong = compare_surfels(field, scene, view, options);
    Eigen::Index row = 0, worst_band = 0;
    const auto net = [&](Eigen::Index b) {
      return wrong.seen(b) > 1e-6 * wrong.seen.maxCoeff() ? (wrong.hidden(b) - wrong.shown(b)) / wrong.seen(b) : 0;
    };
    wrong.seen.maxCoeff(&row, &worst_band);
    for (Eigen::Index b = 0; b < bands; ++b)
      if (std::abs(net(b)) > std::abs(net(worst_band))) worst_band = b;
    std::printf(" %.1f / %.1f | %+.1f |\n", 100 * wrong.hidden(worst_band) / wrong.seen(worst_band),
                100 * wrong.shown(worst_band) / wrong.seen(worst_band), 100 * net(worst_band));
  }
  std::fflush(stdout);
}

void print_head(const std::string& title) {
  std::printf(
      "\n%s\n\n| read as | total, dB | worst band, dB | bands, near to far, dB | cells rms, dB | hidden / shown, %% | "
      "net, "
      "%% |\n|---|---|---|---|---|---|---|\n",
      title.c_str());
}

struct Reading {
  std::string name, path;
  LoadOptions load;
  SamplingKind kind = SamplingKind::surfels;
};

void compare(const std::string& title, const HeightField& field, const View& view,
             const std::vector<Reading>& readings) {
  const auto groups = static_cast<Eigen::Index>(view.head.fan.beams() / 2);
  const Medium medium = medium_of(Water{}, view.head.pulse.centre_frequency);
  const Grid<double> truth =
      energy_by_definition(field, Material{}.lambert_mu, view.head, view.pose, medium, 3, groups, cells);
  print_head(title);
  const Grid<double> wanted = by_band(truth);
  std::printf("| energy, dB below the strongest band | | |");
  for (Eigen::Index b = 0; b < bands; ++b)
    if (wanted(b) > 1e-6 * wanted.maxCoeff()) std::printf(" %.1f", error_db(wanted.maxCoeff(), wanted(b)));
  std::printf(" | | | |\n");
  for (const Reading& r : readings) print_row(r.name, field, truth, load_scene(r.path, r.load), view, r.kind);
}

View view_of(const std::string& sonar, const Eigen::Vector3d& position, double yaw, double pitch, double roll,
             double from, double to) {
  SonarSpec spec = find_sonar(sonar).spec;
  spec.bandwidth = 1500 / (2 * 0.01);
  spec.min_range = from;
  spec.max_range = to;
  const Pose pose = pose_from_yaw_pitch_roll(position, radians(yaw), radians(pitch), radians(roll));
  return {make_head(spec, medium_of(Water{}, spec.centre_frequency).sound_speed), pose};
}

std::string prepared(const std::string& path, const LoadOptions& load, const std::string& to) {
  const LoadedScene loaded = load_scene(path, load);
  save_scene(to, loaded);
  return to;
}

// Returns readings of tiles, which are discs, and of a cloud with its estimated normals as its own.
std::vector<Reading> with_normals(const std::string& path, const LoadOptions& load, const std::string& folder) {
  const SceneCloud scene = load_scene(path, load).scene;
  const std::string tiles = folder + "/normals.tiles", text = folder + "/normals.xyz";
  save_tiles(tiles, scene);
  std::ofstream out(text);
  out << "x y z nx ny nz\n" << std::setprecision(9);
  for (std::size_t i = 0; i < scene.size(); ++i)
    out << (scene.origin + scene.point[i].cast<double>()).transpose() << ' ' << scene.normal[i].transpose() << '\n';
  return {{"tiles", tiles, {}}, {"points with normals", text, {}}};
}

void add(std::vector<Reading>& readings, const std::vector<Reading>& others) {
  readings.insert(readings.end(), others.begin(), others.end());
}

void captured(char** argv, const std::string& folder) {
  const auto number = [&](int i) { return std::stod(argv[i]); };
  LoadOptions load;
  load.viewpoint = Eigen::Vector3d(number(3), number(4), 1000);
  LoadOptions points = load;
  points.mesh_spacing = 0.01;
  const HeightField field = field_of(load_scene(argv[1], load).scene);
  const View view =
      view_of(argv[2], {number(3), number(4), number(5)}, number(6), number(7), number(8), number(9), number(10));
  std::vector<Reading> readings = {{"raster", argv[1], load},
                                   {"surfels 1 cm apart", argv[1], points},
                                   {"prepared", prepared(argv[1], load, folder + "/prepared.ply"), {}},
                                   {"raster, rays", argv[1], load, SamplingKind::rays},
                                   {"surfels 1 cm apart, rays", argv[1], points, SamplingKind::rays}};
  add(readings, with_normals(argv[1], load, folder));
  compare(argv[1], field, view, readings);
}

LoadOptions from_above() {
  LoadOptions load;
  load.viewpoint = Eigen::Vector3d(0, 0, 1000);
  return load;
}

Reading drawn(const std::string& folder, const std::string& name, const HeightField& field, const DrawOptions& draw) {
  const std::string path = folder + "/" + std::to_string(std::hash<std::string>{}(name)) + ".xyz";
  std::ofstream(path) << text_of(draw_points(field, draw));
  return Reading{name, path, from_above()};
}

void generated(const std::string& folder) {
  const View side = view_of("oculus-m750d", {-3.5, 0, 2.2}, 0, 15, 0, 1, 7),
             low = view_of("oculus-m750d", {-3.3, -0.5, 1.2}, 10, 8, 0, 0.5, 6.5),
             steep = view_of("oculus-m750d", {-2, 2, 2.5}, -40, 40, 5, 1, 5.5);
  const HeightField field = rough_field({.half = 3, .spacing = 0.02});
  std::vector<Reading> readings = {drawn(folder, "regular", field, {}),
                                   drawn(folder, "jittered", field, {.jitter = 0.35}),
                                   drawn(folder, "1 : 5", field, {.stretch = 5}),
                                   drawn(folder, "noise of 1/4", field, {.noise = 0.25}),
                                   drawn(folder, "noise of 1/4, jittered", field, {.jitter = 0.35, .noise = 0.25}),
                                   drawn(folder, "noise of 1", field, {.noise = 1})};
  Reading points = readings[0], rays = readings[0];
  points.name = "regular, as surfels 1 cm apart", points.load.mesh_spacing = 0.01;
  rays.name = "regular, rays", rays.kind = SamplingKind::rays;
  readings.push_back(points), readings.push_back(rays);
  for (const std::size_t r : {0u, 1u, 3u})
    readings.push_back({readings[r].name + ", prepared",
                        prepared(readings[r].path, readings[r].load, folder + "/" + std::to_string(r) + ".ply"),
                        {}});
  add(readings, with_normals(readings[1].path, readings[1].load, folder));
  compare("15 degrees down", field, side, readings);
  compare("8 degrees down", field, low, readings);
  compare("40 degrees down", field, steep, readings);
  const HeightField open = with_holes(field, 0.12, 1);
  compare("8 degrees down, with holes", open, low,
          {drawn(folder, "regular, holes", open, {}), drawn(folder, "jittered, holes", open, {.jitter = 0.35})});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 1 && argc != 11) {
    std::fprintf(stderr, "usage: exact_height_field [CLOUD SONAR X Y Z YAW PITCH ROLL MIN_RANGE MAX_RANGE]\n");
    return 2;
  }
  try {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("exact_height_field_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    if (argc == 11)
      captured(argv, folder.string());
    else
      generated(folder.string());
    std::filesystem::remove_all(folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "exact_height_field: %s\n", error.what());
    return 1;
  }
  return 0;
}
