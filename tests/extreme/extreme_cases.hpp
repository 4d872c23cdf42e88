#pragma once
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/shading.hpp"
#include "beamforming/sonar_spec.hpp"
#include "beamforming/synthesize.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/scene_cloud.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify::extreme {

using Complex = std::complex<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A small sonar: 9 beams over 40 degrees, ranges 1 to 12 m, some 700 bins.
inline SonarSpec small_sonar() {
  SonarSpec s;
  s.name = "small";
  s.centre_frequency = 450e3;
  s.bandwidth = 20e3;
  s.beams = 9;
  s.field_of_view = radians(40);
  s.beam_width = radians(4);
  s.elevation_width = radians(40);
  s.min_range = 1;
  s.max_range = 12;
  return s;
}

/// Water without absorption at 1500 m/s.
inline Medium clear_water() { return {1500, {}}; }

inline SonarHead small_head() { return make_head(small_sonar(), 1500); }

/// One head-on beam of one element over a gate whose bin centres fall on every multiple of 2 mm.
inline SonarHead single_beam(const Pulse& pulse, double min_range, double max_range) {
  SonarHead head;
  head.name = "single";
  head.pulse = pulse;
  head.fan = make_fan(1, 1, 1, 1);
  head.array = {0.5 * 1500 / pulse.centre_frequency, {1.0}};
  head.gate = {min_range - 0.001, max_range + 0.001, 0.002};
  return head;
}

inline Scatterers targets_at(const std::vector<double>& range, double azimuth = 0, double elevation = 0) {
  Scatterers s;
  s.range = range;
  s.azimuth.assign(range.size(), azimuth);
  s.elevation.assign(range.size(), elevation);
  return s;
}

/// Echoes of targets of cross-section sigma [m^2] and amplitude 1.
inline Echoes echoes_of(const Scatterers& targets, const Pulse& pulse, const Medium& medium, double sigma = 1) {
  const std::vector<double> sigmas(targets.size(), sigma);
  const std::vector<Complex> xi(targets.size(), 1);
  return target_echoes(targets, sigmas, xi, pulse, medium);
}

/// A flat square plate of n x n surfels that faces the head from x, centred on the x axis.
inline SceneCloud plate(double x, double size, int n, const Eigen::Vector3d& normal = {-1, 0, 0}) {
  SceneCloud scene;
  const double step = size / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      add_surfel(scene, {x, (i + 0.5) * step - size / 2, (j + 0.5) * step - size / 2}, normal, step * step);
  return scene;
}

inline SimulatedPing ping_of(const SceneCloud& scene, const SimulationOptions& options = {},
                             const SonarSpec& spec = small_sonar(), const Water& water = {}) {
  return simulate_ping(scene, make_head(spec, sound_speed(water)), Pose::Identity(), {water}, options);
}

inline ComplexGrid image(const SimulatedPing& p) { return p.ping.pressure.cast<Complex>(); }

inline bool same(const ComplexGrid& a, const ComplexGrid& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a == b).all();
}

inline double relative_l2(const ComplexGrid& a, const ComplexGrid& b) {
  return std::sqrt((a - b).abs2().sum() / b.abs2().sum());
}

/// Expects that all outputs of a ping are finite numbers.
inline bool all_finite(const SimulatedPing& p) {
  bool finite = p.ping.pressure.isFinite().all() && level_db(p.ping).isFinite().all();
  finite = finite && std::isfinite(p.noise_floor_db) && std::isfinite(p.medium.sound_speed);
  for (std::size_t i = 0; i < p.scatterers.size(); ++i)
    finite = finite && std::isfinite(p.scatterers.range[i]) && std::isfinite(p.scatterers.azimuth[i]) &&
             std::isfinite(p.scatterers.elevation[i]) && std::isfinite(p.scatterers.cos_incidence[i]) &&
             std::isfinite(p.scatterers.projected_area[i]);
  for (std::size_t i = 0; i < p.soundings.size(); ++i)
    finite = finite && p.soundings.position[i].allFinite() && std::isfinite(p.soundings.level_db[i]);
  return finite;
}

/// Runs `call`, which must throw Error of `kind` with all `parts` in one line of text.
template <typename Call>
void expect_refused(ErrorKind kind, const std::vector<std::string>& parts, const Call& call) {
  try {
    call();
    ADD_FAILURE() << "not refused; expected '" << parts.front() << "'";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(kind)) << error.what();
    for (const std::string& part : parts) EXPECT_THAT(error.what(), ::testing::HasSubstr(part));
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not an Error: " << error.what();
  }
}

}  // namespace insonify::extreme
