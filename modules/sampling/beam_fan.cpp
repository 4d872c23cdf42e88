#include "sampling/beam_fan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

BeamFan make_fan(std::size_t beams, double field_of_view, double beam_width, double elevation_width, double elevation) {
  if (beams == 0) fail(ErrorKind::argument, "make_fan: beams = 0, must be at least 1");
  if (!(field_of_view > 0 && field_of_view <= 2 * pi) && !(beams == 1 && field_of_view == 0))
    fail(ErrorKind::argument, "make_fan: field_of_view = ", field_of_view, " rad, must be > 0 and at most 2 pi");
  BeamFan fan;
  fan.beam_width = beam_width;
  fan.elevation_width = elevation_width;
  fan.elevation.assign(beams, elevation);
  for (std::size_t b = 0; b < beams; ++b)
    fan.azimuth.push_back(field_of_view * ((static_cast<double>(b) + 0.5) / static_cast<double>(beams) - 0.5));
  require_valid(fan, "make_fan");
  return fan;
}

void require_valid(const BeamFan& fan, const char* who) {
  if (fan.beams() == 0) fail(ErrorKind::argument, who, ": fan has no beams, must have at least 1");
  if (fan.elevation.size() != fan.beams())
    fail(ErrorKind::argument, who, ": fan.elevation has ", fan.elevation.size(), " entries, must have one per beam (",
         fan.beams(), ")");
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    if (!(std::abs(fan.azimuth[b]) <= pi))
      fail(ErrorKind::argument, who, ": fan.azimuth[", b, "] = ", fan.azimuth[b], " rad, must be within +-pi");
    if (!(std::abs(fan.elevation[b]) <= pi / 2))
      fail(ErrorKind::argument, who, ": fan.elevation[", b, "] = ", fan.elevation[b], " rad, must be within +-pi/2");
  }
  if (!(fan.beam_width > 0 && std::isfinite(fan.beam_width)))
    fail(ErrorKind::argument, who, ": fan.beam_width = ", fan.beam_width, " rad, must be > 0");
  if (!(fan.elevation_width > 0 && std::isfinite(fan.elevation_width)))
    fail(ErrorKind::argument, who, ": fan.elevation_width = ", fan.elevation_width, " rad, must be > 0");
  if (!(fan.row_width >= 0 && std::isfinite(fan.row_width)))
    fail(ErrorKind::argument, who, ": fan.row_width = ", fan.row_width, " rad, must be >= 0; 0: no planar array");
}

std::vector<FanRow> fan_rows(const BeamFan& fan) {
  std::map<double, FanRow> by_elevation;
  for (std::size_t b = 0; b < fan.beams(); ++b) by_elevation[fan.elevation[b]].beams.push_back(b);
  std::vector<FanRow> rows;
  for (auto& [elevation, row] : by_elevation) rows.push_back({elevation, std::move(row.beams)});
  return rows;
}

Sector insonified_sector(const BeamFan& fan, double elevation_half_extent, double azimuth_margin) {
  require_valid(fan, "insonified_sector");
  std::vector<double> azimuth = fan.azimuth;
  std::sort(azimuth.begin(), azimuth.end());

  // The fan is the complement of the widest azimuth gap between beams, so it may extend across +-pi (a head that looks
  // astern).
  double begin = azimuth.front(), widest = azimuth.front() + 2 * pi - azimuth.back();
  for (std::size_t b = 1; b < azimuth.size(); ++b)
    if (azimuth[b] - azimuth[b - 1] > widest) {
      widest = azimuth[b] - azimuth[b - 1];
      begin = azimuth[b];
    }
  const double centre = begin + (2 * pi - widest) / 2;
  const double half = std::min(pi, (2 * pi - widest) / 2 + (azimuth_margin > 0 ? azimuth_margin : fan.beam_width));
  const auto [low, high] = std::minmax_element(fan.elevation.begin(), fan.elevation.end());
  return {centre - half, centre + half, std::max(-pi / 2, *low - elevation_half_extent),
          std::min(pi / 2, *high + elevation_half_extent)};
}

}  // namespace insonify
