// SPDX-License-Identifier: BSD-3-Clause
// Echoes of the water and of plane boundaries, as sums over cells of complex-normal amplitude (the sonar equation's
// volume and boundary reverberation, Urick, Principles of Underwater Sound, ch. 8; E49 to E51). Steps:
//   1. reverberation_cells   slices of range, a fraction of a pulse long, across gate and sector
//   2. the number of cells is checked before any work
//   3. each cell             one echo at a random place in it, its power that of the whole cell; places and amplitudes
//                            are counted by ping (or place of the head), slice and direction, never drawn in sequence
// Planes are cut into range x azimuth, the water into range x azimuth x layers of equal share of the elevation pattern.
// Cost: slices x directions (x layers) echoes of constant cost, at most 2^27, in parallel blocks of slices joined in
// order.
#include "acoustics/reverberation_echoes.hpp"

#include <algorithm>
#include <cmath>

#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/reverberation_cells_internal.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t slices_per_block = 64;
constexpr double pattern_floor = 1e-4;  // -80 dB: cells below it are left out
constexpr double metres_per_second_per_knot = 1852.0 / 3600.0;

struct ScatteringPlane {
  const char* name;
  double height;      ///< world z [m]
  double side;        ///< 1: above the head, -1: below
  double strength;    ///< cross-section per area at all angles, which adds to that of the material
  Material material;  ///< its lambert_mu is 0 where `strength` is the whole law
  RandomStage stage;
};

class PlaneEchoes {
 public:
  /// `first` is the first number of the random counter.
  PlaneEchoes(const ScatteringPlane& plane, std::uint64_t first, const ReverberationCells& cells,
              const Pose& world_from_head, const Transmission& sent, const char* who)
      : plane_(plane),
        first_(first),
        distance_(std::abs(plane.height - world_from_head.translation().z())),
        cells_(cells),
        sector_(cells.sector),
        echo_options_(sent.echo_options),
        source_(source_pressure(sent.pulse)),
        surface_(surface_table({&plane.material, 1}, sent.pulse.centre_frequency, sent.medium.sound_speed).front()),
        two_over_c_(2 / sent.medium.sound_speed) {
    const Eigen::Matrix3d to_head = world_from_head.linear().transpose();
    forward_ = to_head.col(0);
    left_ = to_head.col(1);
    to_plane_ = plane.side * distance_ * to_head.col(2);
    directions_ = static_cast<std::size_t>(std::ceil(cells.azimuths));
    step_ = 2 * pi / static_cast<double>(directions_);
    require_few(std::ceil(cells.azimuths), cells, who);
    centre_.reserve(directions_);
    for (std::size_t j = 0; j < directions_; ++j) centre_.push_back(direction((static_cast<double>(j) + 0.5) * step_));
  }

  Echoes echoes() const {
    return collect_echoes(cells_.slices, slices_per_block, echo_options_.threads,
                          [&](std::size_t begin, std::size_t end, Echoes& out) {
                            for (std::size_t k = begin; k < end; ++k) slice_echo(k, out);
                          });
  }

 private:
  Vector3d direction(double angle) const { return std::cos(angle) * forward_ + std::sin(angle) * left_; }

  void slice_echo(std::size_t k, Echoes& out) const {
    const double r1 = std::max(cells_.begin(k), distance_), r2 = cells_.end(k);
    if (!(r2 > r1)) return;
    const double area = 0.5 * (r2 * r2 - r1 * r1) * step_;  // rho drho = r dr
    const double middle = std::sqrt(0.5 * (r1 * r1 + r2 * r2) - distance_ * distance_);
    const double spare = middle * step_;  // one cell
    for (std::size_t j = 0; j < directions_; ++j)
      if (sector_.in_cones(to_plane_ + middle * centre_[j], spare)) cell_echo(k, j, r1, r2, area, out);
  }

  void cell_echo(std::size_t k, std::size_t j, double r1, double r2, double area, Echoes& out) const {
    const RandomCounter counter{first_, cells_.first + k, j};
    const auto jitter = random_uniform(echo_options_.seed, plane_.stage, counter);
    const double r = std::sqrt(r1 * r1 + jitter[2] * (r2 * r2 - r1 * r1));
    const double rho = std::sqrt(std::max(0.0, (r - distance_) * (r + distance_)));
    const Vector3d position = to_plane_ + rho * direction((static_cast<double>(j) + jitter[3]) * step_);
    const double v = std::clamp(position.z() / r, -1.0, 1.0);
    const double pattern = elevation_pattern(echo_options_, std::asin(v));
    if (!(std::abs(pattern) >= pattern_floor)) return;
    const double sine = distance_ / r;  // of the grazing angle
    const double sigma = plane_.strength * area + cross_section(*surface_, {sine, sine, sine * area});  // (E50, E51)
    const double transmitted = transmit_pattern(echo_options_, std::atan2(position.y(), position.x()));
    add_echo(out, two_over_c_ * r, position.y() / r, v,
             source_ * std::sqrt(sigma) * pattern * transmitted / (r * r) *
                 cell_amplitude(echo_options_, plane_.stage, counter));
  }

  const ScatteringPlane& plane_;
  std::uint64_t first_;
  double distance_;  // from the head [m]
  const ReverberationCells& cells_;
  SectorBounds sector_;
  const EchoOptions& echo_options_;
  double source_;
  SurfaceTable::value_type surface_;
  double two_over_c_, step_ = 0;
  Vector3d forward_, left_, to_plane_;  // in head axes; to_plane_: to the foot of the head's perpendicular
  std::size_t directions_ = 0;
  std::vector<Vector3d> centre_;
};

Echoes plane_echoes(const ScatteringPlane& plane, const Pose& world_from_head, const ReverberationCells& cells,
                    const Transmission& sent, std::uint64_t first, const char* who) {
  const double head = world_from_head.translation().z();
  if (!(plane.side * (plane.height - head) > 0))
    fail(ErrorKind::argument, who, ": the head stands at height ", head, " m, must be ",
         plane.side > 0 ? "below " : "above ", plane.name, ".height = ", plane.height, " m");
  return PlaneEchoes(plane, first, cells, world_from_head, sent, who).echoes();
}

/// Which bottom is under a head: its position, rounded to `step`.
std::uint64_t counter_of_point(const Vector3d& position, double step) {
  std::uint64_t counter = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double rounded = std::nearbyint(position[axis] / step);
    counter = counter << 21 | (static_cast<std::uint64_t>(std::fmod(rounded, 0x1p20) + 0x1p20) & 0x1fffff);
  }
  return counter;
}

/// Echoes of the water. Beams that resolve elevations need several echoes per cell, one for each equal part of the
/// elevation pattern: layers.
class VolumeEchoes {
 public:
  VolumeEchoes(double scattering_db, const ReverberationCells& cells, const BeamFan& fan, const Transmission& sent,
               const ReverberationOptions& options, const char* who)
      : cells_(cells),
        sector_(cells.sector),
        echo_options_(sent.echo_options),
        law_(fan, sent.echo_options),
        ping_(static_cast<std::uint64_t>(options.ping)),
        two_over_c_(2 / sent.medium.sound_speed) {
    const double row = fan.row_width > 0 ? fan.row_width : fan.elevation_width;
    const bool resolved = fan.row_width > 0 || !(echo_options_.elevation_width > 0);
    const double layers = resolved ? std::ceil(options.cells_per_resolution * law_.extent() / row) : 1;
    const auto [low, high] = azimuths_of(cells.sector);
    const double azimuths = std::ceil(cells.azimuths * (high - low) / (2 * pi));
    require_few(azimuths * layers, cells, who);
    azimuths_ = static_cast<std::size_t>(azimuths);
    layers_ = static_cast<std::size_t>(layers);
    min_azimuth_ = low;
    step_ = (high - low) / azimuths;
    source_ = source_pressure(sent.pulse) *
              std::sqrt(power_from_db(scattering_db) * step_ * law_.integral() / layers);  // (E49)
  }

  Echoes echoes() const {
    return collect_echoes(cells_.slices, slices_per_block, echo_options_.threads,
                          [&](std::size_t begin, std::size_t end, Echoes& out) {
                            for (std::size_t k = begin; k < end; ++k)
                              for (std::size_t a = 0; a < azimuths_; ++a)
                                for (std::size_t e = 0; e < layers_; ++e) cell_echo(k, a, e, out);
                          });
  }

 private:
  void cell_echo(std::size_t k, std::size_t a, std::size_t e, Echoes& out) const {
    const RandomCounter counter{ping_, cells_.first + k, a * layers_ + e};
    const auto jitter = random_uniform(echo_options_.seed, RandomStage::volume, counter);
    const TwoUniform upward_outward = split_uniform(jitter[2]);
    const double cube1 = std::pow(cells_.begin(k), 3), cube2 = std::pow(cells_.end(k), 3);
    const double r = std::cbrt(cube1 + upward_outward.rest * (cube2 - cube1));
    const double azimuth = min_azimuth_ + (static_cast<double>(a) + jitter[3]) * step_;
    const double share = (static_cast<double>(e) + upward_outward.leading) / static_cast<double>(layers_);
    const double elevation = law_.elevation_at(share);
    if (!sector_.in_cones(unit_vector({azimuth, elevation}))) return;
    const double size = source_ * std::sqrt((cube2 - cube1) / 3) * transmit_pattern(echo_options_, azimuth) / (r * r);
    add_echo(out, two_over_c_ * r, std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
             size * cell_amplitude(echo_options_, RandomStage::volume, counter));
  }

  const ReverberationCells& cells_;
  SectorBounds sector_;
  const EchoOptions& echo_options_;
  ElevationLaw law_;
  std::uint64_t ping_;
  std::size_t azimuths_ = 0, layers_ = 0;
  double two_over_c_, min_azimuth_ = 0, step_ = 0, source_ = 0;
};

}  // namespace

Echoes volume_echoes(const Environment& environment, const BeamFan& fan, const RangeGate& gate,
                     const Transmission& transmission, const ReverberationOptions& options) {
  constexpr const char* me = "volume_echoes";
  require_valid(environment, me);
  if (!environment.volume_scattering_db) fail(ErrorKind::argument, me, ": environment has no volume_scattering_db");
  const ReverberationCells cells = reverberation_cells(fan, gate, transmission, options, me);
  return VolumeEchoes(*environment.volume_scattering_db, cells, fan, transmission, options, me).echoes();
}

Echoes surface_echoes(const Environment& environment, const Pose& world_from_head, const BeamFan& fan,
                      const RangeGate& gate, const Transmission& transmission, const ReverberationOptions& options) {
  constexpr const char* me = "surface_echoes";
  require_valid(environment, me);
  if (!environment.surface || !environment.surface->scattering_strength_db)
    fail(ErrorKind::argument, me, ": environment has no surface.scattering_strength_db");
  return plane_echoes({"surface",
                       environment.surface->height,
                       1,
                       power_from_db(*environment.surface->scattering_strength_db),
                       {"sea surface", 0},
                       RandomStage::sea_surface},
                      world_from_head, reverberation_cells(fan, gate, transmission, options, me), transmission,
                      static_cast<std::uint64_t>(options.ping), me);
}

Echoes bottom_echoes(const Environment& environment, const Pose& world_from_head, const BeamFan& fan,
                     const RangeGate& gate, const Transmission& transmission, const ReverberationOptions& options) {
  constexpr const char* me = "bottom_echoes";
  require_valid(environment, me);
  if (!environment.bottom || !environment.bottom->lambert_mu)
    fail(ErrorKind::argument, me, ": environment has no bottom.lambert_mu");
  const ReverberationCells cells = reverberation_cells(fan, gate, transmission, options, me);
  return plane_echoes({"bottom",
                       environment.bottom->height,
                       -1,
                       0,
                       {"flat bottom", *environment.bottom->lambert_mu},
                       RandomStage::flat_bottom},
                      world_from_head, cells, transmission,
                      counter_of_point(world_from_head.translation(), cells.length), me);
}

double chapman_harris_strength_db(double frequency, double wind_speed, double grazing) {
  constexpr const char* me = "chapman_harris_strength_db";
  require(frequency > 0 && std::isfinite(frequency), me, "frequency", frequency, "Hz", "finite and > 0");
  require(wind_speed > 0 && std::isfinite(wind_speed), me, "wind_speed", wind_speed, "m/s", "finite and > 0");
  require(grazing > 0 && grazing <= pi / 2, me, "grazing", grazing, "rad", "> 0 and at most pi/2");
  const double beta = 158 * std::pow(wind_speed / metres_per_second_per_knot * std::cbrt(frequency), -0.58);
  return 3.3 * beta * std::log10(degrees(grazing) / 30) - 42.4 * std::log10(beta) + 2.6;  // (E50)
}

}  // namespace insonify
