// SPDX-License-Identifier: BSD-3-Clause
// Sampling of point clouds against the true surfaces they were scanned from: sampling_accuracy [SPACING_MM ...].
//
// Three tables: range errors of rays, the same apart near silhouettes and elsewhere, and surfels hidden or shown
// wrongly. Holes: rays that should have met a surface and met nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "sampling/find_scatterers.hpp"
#include "true_world.hpp"

namespace {

using namespace insonify;

constexpr double far_off = 0.3;  // error [m] beyond which a ray met another object

struct View {
  std::string name;
  Pose pose;
  BeamFan fan;
  RangeGate gate;
};

std::vector<View> views() {
  const BeamFan low = make_fan(256, radians(40), radians(0.5), radians(5));
  const BeamFan high = make_fan(256, radians(40), radians(0.5), radians(20));
  // Every direction meets the bed or the wall behind it: what is missed is a hole.
  return {{"grazing", pose_from_yaw_pitch_roll({2, 0, -4.5}, 0, radians(14), 0), low, {0.5, 60, 0.01}},
          {"steep", pose_from_yaw_pitch_roll({14, 0, -1}, 0, radians(80), 0), high, {0.5, 30, 0.01}},
          {"normal", pose_from_yaw_pitch_roll({19, 0, -1}, 0, radians(90), 0), high, {0.5, 30, 0.01}}};
}

// Absolute errors with their statistics for a table.
struct Errors {
  std::vector<double> size;

  void add(double error) { size.push_back(std::abs(error)); }
  void sort() { std::sort(size.begin(), size.end()); }
  double quantile_mm(double q) const {
    return size.empty() ? 0 : 1e3 * size[static_cast<std::size_t>(q * static_cast<double>(size.size() - 1))];
  }
  double far_percent() const {
    const auto far = size.end() - std::upper_bound(size.begin(), size.end(), far_off);
    return size.empty() ? 0 : 100.0 * static_cast<double>(far) / static_cast<double>(size.size());
  }
};

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns true if the true range jumps within `distance` of the position that the ray meets: on one of four lines across
// it, the inverse range differs by more than far_off from the linear one of a plane.
bool is_near_silhouette(const World& world, const Vector3d& from, const Vector3d& along, double range,
                        double distance) {
  const Vector3d right = along.unitOrthogonal(), up = along.cross(right);
  for (int line = 0; line < 4; ++line) {
    const Vector3d step = distance / range * (std::cos(line * pi / 4) * right + std::sin(line * pi / 4) * up);
    double inverse = 0;
    for (const double side : {-1.0, 1.0}) {
      const Vector3d beside = along + side * step;
      const auto r = world.truth(from, beside.normalized());
      inverse += 0.5 * (r ? beside.norm() / *r : 0);
    }
    if (!(std::abs(1 / inverse - range) <= far_off)) return true;
  }
  return false;
}

bool same(const Sampling& a, const Sampling& b) {
  return a.scatterers.range == b.scatterers.range && a.scatterers.id == b.scatterers.id &&
         a.scatterers.cos_incidence == b.scatterers.cos_incidence && a.report.rays_missed == b.report.rays_missed &&
         a.report.rays_unknown == b.report.rays_unknown;
}

struct Tables {
  std::string rays, silhouettes, surfels;
};

template <typename... Values>
void add_row(std::string& table, const char* format, Values... values) {
  char row[256];
  std::snprintf(row, sizeof row, format, values...);
  table += row;
}

void compare_rays(const World& world, const PreparedScene& scene, double spacing, const View& view, Tables& tables) {
  SamplingOptions options{.kind = SamplingKind::rays, .projection = Projection::kdtree, .rays_per_beam = 64};
  const Sampling sampling = find_scatterers(scene, view.pose, view.fan, view.gate, options);
  options.projection = Projection::raster;
  const bool agree = same(sampling, find_scatterers(scene, view.pose, view.fan, view.gate, options));

  // The truth along every ray that gave an echo.
  const Scatterers& s = sampling.scatterers;
  const Vector3d from = view.pose.translation();
  std::vector<double> truth(s.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::uint8_t> at_edge(s.size(), 0);
  parallel_blocks(s.size(), 64, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3d along = view.pose.linear() * unit_vector({s.azimuth[i], s.elevation[i]});
      const auto range = world.truth(from, along);
      if (!range) continue;
      truth[i] = *range;
      at_edge[i] = is_near_silhouette(world, from, along, *range, 2 * spacing);
    }
  });

  Errors all, edge, rest;
  std::vector<double> errors;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (std::isnan(truth[i])) continue;
    errors.push_back(s.range[i] - truth[i]);
    all.add(errors.back());
    (at_edge[i] ? edge : rest).add(errors.back());
  }
  for (Errors* e : {&all, &edge, &rest}) e->sort();
  const std::size_t cast = view.fan.beams() * static_cast<std::size_t>(options.rays_per_beam);
  const auto percent = [&](std::size_t n) { return 100.0 * static_cast<double>(n) / static_cast<double>(cast); };
  const char* const name = view.name.c_str();
  add_row(tables.rays, "| %s | %.0f | %zu | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f | %.0f | %.2f | %s |\n", name,
          1e3 * spacing, s.size(), percent(cast - s.size() - sampling.report.rays_missed),
          percent(sampling.report.rays_missed), percent(sampling.report.rays_unknown), 1e3 * median_of(errors),
          all.quantile_mm(0.5), all.quantile_mm(0.9), all.quantile_mm(0.99), all.far_percent(), agree ? "yes" : "NO");
  add_row(tables.silhouettes, "| %s | %.0f | %.1f | %.2f / %.0f / %.0f | %.1f | %.2f / %.1f / %.0f | %.2f |\n", name,
          1e3 * spacing, percent(edge.size.size()), edge.quantile_mm(0.5), edge.quantile_mm(0.9),
          edge.quantile_mm(0.99), edge.far_percent(), rest.quantile_mm(0.5), rest.quantile_mm(0.9),
          rest.quantile_mm(0.99), rest.far_percent());
}

// Compares surfels with the true line of sight to their centres, weighted by their Lambert cross-sections.
void compare_surfels(const World& world, const PreparedScene& scene, double spacing, const View& view, Tables& tables) {
  constexpr double on_surface = 0.01;  // [m]
  constexpr std::size_t most = 40000;
  SamplingOptions options{.scatterers_per_cell = 0};
  const Scatterers seen = find_scatterers(scene, view.pose, view.fan, view.gate, options).scatterers;
  options.occlusion = false;
  const Scatterers all = find_scatterers(scene, view.pose, view.fan, view.gate, options).scatterers;
  std::vector<std::uint8_t> is_seen(scene.scene().size(), 0);
  for (const std::uint32_t surfel : seen.surfel) is_seen[surfel] = 1;

  const std::size_t stride = all.size() / most + 1, looked_at = all.size() / stride;
  std::vector<std::uint8_t> open(looked_at, 0);
  parallel_blocks(looked_at, 64, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = k * stride;
      const Vector3d along = view.pose.linear() * unit_vector({all.azimuth[i], all.elevation[i]});
      open[k] = world.truth(view.pose.translation(), along).value_or(none) > all.range[i] - on_surface;
    }
  });
  double visible_energy = 0, hidden = 0, shown = 0;
  for (std::size_t k = 0; k < looked_at; ++k) {
    const std::size_t i = k * stride;
    const double energy = all.projected_area[i] * all.cos_incidence[i];
    visible_energy += open[k] ? energy : 0;
    hidden += open[k] && !is_seen[all.surfel[i]] ? energy : 0;
    shown += !open[k] && is_seen[all.surfel[i]] ? energy : 0;
  }
  add_row(tables.surfels, "| %s | %.0f | %zu | %.2f | %.2f | %.2f |\n", view.name.c_str(), 1e3 * spacing, seen.size(),
          100 * hidden / visible_energy, 100 * shown / visible_energy,
          10 * std::log10((visible_energy - hidden + shown) / visible_energy));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<double> spacings;
  for (int i = 1; i < argc; ++i) spacings.push_back(1e-3 * std::atof(argv[i]));
  if (spacings.empty()) spacings = {0.16, 0.08, 0.04, 0.02};

  const World world;
  Tables tables = {
      "| view | spacing, mm | rays with echo | blocked, % | holes, % | unknown, % | median error, mm | p50, mm | p90, "
      "mm "
      "| p99, mm | over 0.3 m, % | kdtree = raster |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      "| view | spacing, mm | rays near a silhouette, % | there: p50 / p90 / p99, mm | over 0.3 m, % | elsewhere: p50 "
      "/ "
      "p90 / p99, mm | over 0.3 m, % |\n|---|---|---|---|---|---|---|\n",
      "| view | spacing, mm | surfels seen | wrongly hidden, % | wrongly shown, % | level, dB "
      "|\n|---|---|---|---|---|---|"
      "\n"};
  for (const double spacing : spacings) {
    const SceneCloud cloud = world.scan(spacing);
    const PreparedScene scene(cloud);
    for (const View& view : views()) {
      compare_rays(world, scene, spacing, view, tables);
      compare_surfels(world, scene, spacing, view, tables);
    }
  }
  std::printf("%s\n%s\n%s", tables.rays.c_str(), tables.silhouettes.c_str(), tables.surfels.c_str());
}
