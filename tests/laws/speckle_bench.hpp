// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "core/random.hpp"
#include "sampling/find_scatterers.hpp"
#include "support/point_targets.hpp"
#include "support/test.hpp"

namespace insonify::laws {

using Complex = std::complex<double>;

constexpr double frequency = 900e3, speed = 1500, wavelength = speed / frequency;

/// Returns a uniform half-wavelength array of 101 elements, 50.5 wavelengths long: 1 degree wide at broadside.
inline LineArray one_degree_array() { return {wavelength / 2, std::vector<double>(101, 1.0)}; }

/// Returns a head with `array` and beams at these azimuths [rad]. Patches up to 6 degrees beside them are insonified;
/// beyond, a uniform beam has less than 2 % of its energy.
inline SonarHead head_with(const LineArray& array, const std::vector<double>& azimuths, double bandwidth,
                           const RangeGate& gate) {
  SonarHead head;
  head.name = "laws";
  head.pulse = {frequency, bandwidth, 220};
  head.array = array;
  head.gate = gate;
  head.fan = make_fan(1, 1, radians(6), radians(60));
  head.fan.azimuth = azimuths;
  head.fan.elevation.assign(azimuths.size(), 0);
  return head;
}

/// Returns a single hydrophone and bins as long as the pulse.
inline SonarHead single_hydrophone(double max_range) {
  const double bandwidth = 100e3;
  const double bin = 0.44 * speed / (2 * bandwidth);
  return head_with({wavelength / 2, {1.0}}, {0}, bandwidth, {10 - bin / 2, max_range, bin});
}

/// Groups of patches, each group at one range far from the others, so one bin receives one group.
struct Groups {
  SonarHead head;
  Scatterers scatterers;
  std::vector<Eigen::Index> bin;    ///< bin of each group
  std::vector<double> patch_power;  ///< mean intensity of one patch in that bin [Pa^2]
};

/// Returns number[g] patches in group g, all alike and at one position. `first_id` distinguishes the groups of several
/// calls.
inline Groups make_groups(const std::vector<int>& number, std::uint64_t first_id = 0) {
  constexpr int bins_apart = 8;  // 8 pulse lengths: the envelope is below 1e-70
  Groups groups;
  const double bin = single_hydrophone(11).gate.bin_size;
  groups.head = single_hydrophone(10 + bins_apart * bin * static_cast<double>(number.size()));
  const double source = source_pressure(groups.head.pulse), sigma = 1e-4;
  Scatterers& s = groups.scatterers;
  for (std::size_t g = 0; g < number.size(); ++g) {
    groups.bin.push_back(static_cast<Eigen::Index>(g) * bins_apart);
    const double range = groups.head.gate.centre(g * bins_apart);
    groups.patch_power.push_back(std::pow(source / (range * range), 2) * sigma);
    for (int i = 0; i < number[g]; ++i) {
      s.id.push_back(first_id + s.range.size());
      s.range.push_back(range);
    }
  }
  s.azimuth.assign(s.range.size(), 0);
  s.elevation.assign(s.range.size(), 0);
  s.cos_incidence.assign(s.range.size(), 1);
  s.projected_area.assign(s.range.size(), static_cast<float>(sigma));
  s.material.assign(s.range.size(), 0);
  s.surfel.assign(s.range.size(), 0);
  return groups;
}

/// Returns the complex pressure of every group in units of one patch's rms.
inline std::vector<Complex> pressure_of_groups(const Groups& groups, const EchoOptions& options,
                                               double coherent_fraction = 0) {
  const std::vector<Material> materials{{"patch", 1.0, coherent_fraction, 0}};
  const Echoes echoes = direct_echoes(groups.scatterers, materials, groups.head.pulse, clear_water(), options);
  const ComplexGrid pressure = synthesize_gridded(echoes, groups.head, clear_water());
  std::vector<Complex> pressures;
  for (std::size_t g = 0; g < groups.bin.size(); ++g) {
    // Without the known phase of the carrier a coherent patch is real and positive.
    const double cycles = reduced_cycles(2 / wavelength * groups.head.gate.centre(g * 8));
    pressures.push_back(pressure(0, groups.bin[g]) *
                        std::polar(1 / std::sqrt(groups.patch_power[g]), -2 * pi * cycles));
  }
  return pressures;
}

/// Means of the intensity and of its square, of the amplitude, and of level and its square in dB.
struct Moments {
  double n = 0, intensity = 0, square = 0, amplitude = 0, level_db = 0, level_square = 0;
  Complex field = 0;
  void add(Complex p) {
    const double i = std::norm(p), db = db_from_power(i);
    ++n;
    intensity += i;
    square += i * i;
    amplitude += std::sqrt(i);
    level_db += db;
    level_square += db * db;
    field += p;
  }
  /// Returns <I^2> / <I>^2.
  double square_ratio() const { return n * square / (intensity * intensity); }
};

/// Returns a flat Lambert bottom 3 m below the head, 6.7 to 9 m away: random surfels, ten and more to a resolution
/// cell.
inline SceneCloud flat_bottom() {
  SceneCloud scene;
  const double length = 2.4, width = 5, density = 9000;
  const auto count = static_cast<std::uint64_t>(length * width * density);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto u = random_uniform(11, RandomStage::scene_points, {i, 0, 0});
    add_surfel(scene, {6 + length * u[0], width * (u[1] - 0.5), -3}, {0, 0, 1}, 1 / density);
  }
  return scene;
}

inline Scatterers visible(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head) {
  SamplingOptions options;
  options.scatterers_per_cell = 0;
  options.occlusion = false;
  options.elevation_half_extent = radians(60);
  return find_scatterers(scene, world_from_head, head.fan, head.gate, options).scatterers;
}

/// Complex correlation of two fields: <a b*> / sqrt(<|a|^2> <|b|^2>).
class Correlation {
 public:
  void add(Complex a, Complex b) {
    product_ += a * std::conj(b);
    first_ += std::norm(a);
    second_ += std::norm(b);
  }
  Complex value() const { return product_ / std::sqrt(first_ * second_); }

 private:
  Complex product_ = 0;
  double first_ = 0, second_ = 0;
};

}  // namespace insonify::laws
