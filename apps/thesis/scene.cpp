// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <complex>
#include <numbers>

#include "beamforming/synthesize.hpp"
#include "core/units.hpp"
#include "sonar/shading.hpp"
#include "thesis/thesis.hpp"

namespace insonify::thesis {

Pulse table_2_pulse() {
  const double b = 295e3;
  return {900e3, b * std::sqrt(2 * std::numbers::ln2) / pi, 220};
}

Medium medium() { return {speed_of_sound, absorption_about({}, table_2_pulse().centre_frequency, 0)}; }

Scatterers make_object(const Case& which) {
  Scatterers object;
  const double spread = radians(field_of_view), line_gap = object_depth / static_cast<double>(which.rays);
  for (std::size_t column = 0; column < which.beams; ++column)
    for (std::size_t ray = 0; ray < which.rays; ++ray) {
      const double along_line =
          static_cast<double>(ray) + static_cast<double>(column % which.period) / static_cast<double>(which.period);
      const double range = first_range + line_gap * along_line;
      object.range.push_back(range);
      object.azimuth.push_back(spread * (0.5 - static_cast<double>(column) / static_cast<double>(which.beams - 1)));
      object.elevation.push_back(0);
      object.cos_incidence.push_back(1);
      object.projected_area.push_back(static_cast<float>(range * range * ray_width * ray_width));
      object.material.push_back(0);
      object.id.push_back(column * which.rays + ray);
      object.surfel.push_back(0);
    }
  return object;
}

double slice_range() { return make_object({}).range[25 * 21 + 10]; }

Echoes echoes_of_object(const Scatterers& object, std::uint64_t seed) {
  const std::vector<Material> materials{{"object", lambert_mu}};
  EchoOptions options;
  options.seed = seed;
  return direct_echoes(object, materials, table_2_pulse(), medium(), options);
}

LineArray aperture(std::size_t elements) {
  const double wavelength = speed_of_sound / table_2_pulse().centre_frequency;
  const double length = 0.442946 * wavelength / std::sin(beam_width / 2);
  return {length / static_cast<double>(elements), uniform_shading(elements)};
}

SonarHead make_sonar(std::size_t beams, std::size_t elements, double bin_size) {
  SonarHead head;
  head.name = "thesis";
  for (std::size_t b = 0; b < beams; ++b)
    head.fan.azimuth.push_back(radians(field_of_view) *
                               (0.5 - static_cast<double>(b) / static_cast<double>(beams - 1)));
  head.fan.elevation.assign(beams, 0);
  head.fan.beam_width = beam_width;
  head.fan.elevation_width = radians(20);
  head.gate = {first_range - 0.1, first_range + object_depth + 0.1, bin_size};
  head.array = aperture(elements);
  head.pulse = table_2_pulse();
  return head;
}

ComplexGrid column_series(const Echoes& echoes, const Case& which, const SonarHead& head) {
  ComplexGrid series(which.beams, head.gate.bins());
  SonarHead alone = head;
  alone.array = {head.array.spacing, {1}};  // one element is omnidirectional
  for (std::size_t column = 0; column < which.beams; ++column) {
    alone.fan.azimuth = {head.fan.azimuth[column]};
    alone.fan.elevation = {0};
    const Echoes own = select(echoes, [&](std::size_t i) { return i / which.rays == column; });
    series.row(column) = synthesize_spectrum(own, alone, medium());
  }
  return series;
}

Peak find_peak(const ComplexGrid& series, std::size_t row, const RangeGate& gate, double range, double within) {
  const auto bin_of = [&](double r) { return static_cast<std::size_t>((r - gate.min_range) / gate.bin_size); };
  const auto level = [&](std::size_t bin) { return pressure_level_db(std::abs(series(row, bin))); };
  std::size_t best = bin_of(range - within);
  for (std::size_t bin = best; bin <= bin_of(range + within); ++bin)
    if (level(bin) > level(best)) best = bin;
  const double before = level(best - 1), at = level(best), after = level(best + 1);
  const double shift = 0.5 * (before - after) / (before - 2 * at + after);
  return {gate.centre(best), gate.centre(best) + shift * gate.bin_size, at - 0.25 * (before - after) * shift};
}

}  // namespace insonify::thesis
