// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/sampling_error.hpp"

#include <algorithm>
#include <cmath>

#include "acoustics/surface_scattering.hpp"
#include "core/parallel.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/built_in_scenes.hpp"
#include "sonar/sonar_spec.hpp"

namespace insonify {
namespace {

constexpr double height = 3, pitch = radians(30), middle = 6, half_strip = 0.25;
constexpr double size_x = 14, size_y = 8;  // of the clouds [m]

SonarHead bottom_head() {
  SonarSpec s;
  s.name = "bottom";
  s.centre_frequency = 900e3;
  s.bandwidth = 29.5e3;
  s.beams = 21;
  s.field_of_view = radians(20);
  s.beam_width = radians(1);
  s.elevation_width = radians(20);
  s.side_lobe_db = 0;
  s.min_range = 4;
  s.max_range = 10;
  return make_head(s, nominal_sound_speed);
}

class Strip {
 public:
  explicit Strip(const SonarHead& head) : head_(head), power_(head.fan.beams(), 0.0) {}

  void add(double range, double azimuth, double elevation, double sigma) {
    const double x = (range - middle) / half_strip;
    if (std::abs(x) >= 1) return;
    const double weight = std::pow(std::cos(0.5 * pi * x), 2), u = std::cos(elevation) * std::sin(azimuth);
    for (std::size_t b = 0; b < power_.size(); ++b) {
      const double response = array_response(head_.array, nominal_sound_speed / head_.pulse.centre_frequency, u,
                                             std::cos(head_.fan.elevation[b]) * std::sin(head_.fan.azimuth[b]))
                                  .real();
      power_[b] += weight * sigma * response * response / std::pow(range, 4);
    }
  }
  void add(const Scatterers& s) {
    for (std::size_t i = 0; i < s.size(); ++i)
      add(s.range[i], s.azimuth[i], s.elevation[i], lambert_cross_section(1, s.cos_incidence[i], s.projected_area[i]));
  }
  const std::vector<double>& power() const { return power_; }

 private:
  const SonarHead& head_;
  std::vector<double> power_;
};

/// Adds the power that returns from the bottom through the solid angle of a ray.
void add_ray(Strip& strip, const Pose& pose, double azimuth, double elevation, double solid_angle) {
  const double down = -(pose.linear() * unit_vector({azimuth, elevation})).z();
  if (down <= 0) return;
  const double range = height / down;
  strip.add(range, azimuth, elevation, lambert_cross_section(1, down, solid_angle * range * range));
}

class SamplingBench {
 public:
  explicit SamplingBench(const SamplingErrorOptions& options)
      : options_(options),
        head_(bottom_head()),
        pose_(pose_from_yaw_pitch_roll({0, 0, height}, 0, pitch, 0)),
        extent_(0.5 * head_.fan.elevation_width),
        sector_(insonified_sector(head_.fan, extent_)),
        scene_(cloud(60000)),
        exact_(quadrature()) {}

  SamplingErrorRow random_rays(int rays) const {
    return over_trials("random-rays", rays, [&](std::uint64_t seed, Strip& strip) {
      const double least = std::sin(sector_.min_azimuth), width = std::sin(sector_.max_azimuth) - least;
      const std::size_t n = static_cast<std::size_t>(rays) * head_.fan.beams();
      for (std::size_t i = 0; i < n; ++i) {
        const auto at = random_uniform(seed, RandomStage::ray_jitter, {i, 0, 1});
        const double cone = std::asin(least + width * at[0]);
        const auto [low, high] = turns_between(cone, sector_.min_elevation, sector_.max_elevation);
        const Direction d = direction_in_cone(cone, low + (high - low) * at[1]);
        add_ray(strip, pose_, d.azimuth, d.elevation, width * (high - low) / static_cast<double>(n));
      }
      return n;
    });
  }
  SamplingErrorRow jittered_rays(int rays) const {
    return found("jittered-rays", rays, {.kind = SamplingKind::rays, .rays_per_beam = rays}, scene_);
  }
  SamplingErrorRow split_surfels(double per_cell) const {
    return found("split-surfels", per_cell, {.scatterers_per_cell = per_cell}, scene_);
  }
  SamplingErrorRow surfels(std::size_t points) const {
    const double density = static_cast<double>(points) / (size_x * size_y);
    return found("surfels", density, {.scatterers_per_cell = 0}, cloud(points));
  }

 private:
  SceneCloud cloud(std::size_t points) const {
    return make_built_in_scene("plane", {.points = points, .size = {size_x, size_y}, .seed = options_.seed});
  }

  SamplingErrorRow found(const std::string& name, double parameter, SamplingOptions o, const SceneCloud& scene) const {
    o.elevation_half_extent = extent_;
    o.range_resolution = range_resolution(head_.pulse, nominal_sound_speed);
    o.occlusion = false;
    o.threads = options_.threads;
    return over_trials(name, parameter, [&](std::uint64_t seed, Strip& strip) {
      o.seed = seed;
      const Scatterers s = find_scatterers(scene, pose_, head_.fan, head_.gate, o).scatterers;
      strip.add(s);
      return s.size();
    });
  }

  template <typename Sample>
  SamplingErrorRow over_trials(const std::string& name, double parameter, Sample&& sample) const {
    double squares = 0, made = 0;
    std::vector<double> seconds;
    for (int trial = 0; trial < options_.trials; ++trial) {
      Strip strip(head_);
      StopWatch watch;
      made += static_cast<double>(sample(options_.seed + static_cast<std::uint64_t>(trial), strip));
      seconds.push_back(watch.lap());
      for (std::size_t b = 0; b < exact_.size(); ++b) squares += std::pow(strip.power()[b] / exact_[b] - 1, 2);
    }
    std::sort(seconds.begin(), seconds.end());
    const auto trials = static_cast<double>(options_.trials), beams = static_cast<double>(exact_.size());
    const double error = std::sqrt(squares / (trials * beams));
    return {name, parameter, made / (trials * beams), error, db_from_power(1 + error), seconds[seconds.size() / 2]};
  }

  /// Midpoint rule, 600 x 2000 cells, over a smooth integrand.
  std::vector<double> quadrature() const {
    constexpr std::size_t across = 600, up = 2000;
    const double step = (sector_.max_azimuth - sector_.min_azimuth) / across;
    std::vector<Strip> columns(across, Strip(head_));
    parallel_for(across, options_.threads, [&](std::size_t i) {
      const double cone = sector_.min_azimuth + (static_cast<double>(i) + 0.5) * step;
      const auto [low, high] = turns_between(cone, sector_.min_elevation, sector_.max_elevation);
      for (std::size_t k = 0; k < up; ++k) {
        const Direction d = direction_in_cone(cone, low + (static_cast<double>(k) + 0.5) * (high - low) / up);
        add_ray(columns[i], pose_, d.azimuth, d.elevation, std::cos(cone) * step * (high - low) / up);
      }
    });
    std::vector<double> power(head_.fan.beams(), 0.0);
    for (const Strip& column : columns)
      for (std::size_t b = 0; b < power.size(); ++b) power[b] += column.power()[b];
    return power;
  }

  SamplingErrorOptions options_;
  SonarHead head_;
  Pose pose_;
  double extent_;
  Sector sector_;
  SceneCloud scene_;
  std::vector<double> exact_;
};

}  // namespace

std::vector<SamplingErrorRow> measure_sampling_error(const SamplingErrorOptions& options) {
  const SamplingBench bench(options);
  std::vector<SamplingErrorRow> rows;
  for (int rays = 16; rays <= options.most_rays; rays *= 4) rows.push_back(bench.random_rays(rays));
  for (int rays = 16; rays <= options.most_rays; rays *= 4) rows.push_back(bench.jittered_rays(rays));
  for (std::size_t points = 4000; points <= 60u * static_cast<std::size_t>(options.most_rays); points *= 4)
    rows.push_back(bench.surfels(points));
  for (double per_cell = 1; per_cell <= options.most_rays / 256.0; per_cell *= 4)
    rows.push_back(bench.split_surfels(per_cell));
  return rows;
}

}  // namespace insonify
