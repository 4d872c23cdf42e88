#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// The directions in which a head listens, in head axes, one entry per beam, and how wide it sees.
struct BeamFan {
  std::vector<double> azimuth;    ///< [rad], positive to port, ascending or not, regular or not
  std::vector<double> elevation;  ///< [rad], positive up
  double beam_width = 0;          ///< full -3 dB width in azimuth at broadside [rad]
  double elevation_width = 0;     ///< full -3 dB width in elevation [rad]; of a planar array: of its transmitter
  double row_width = 0;           ///< full -3 dB width of a beam in elevation that a planar array forms [rad]; 0: none

  std::size_t beams() const { return azimuth.size(); }
};

/// `beams` directions spread evenly in angle over `field_of_view` [rad], centred on azimuth 0 and `elevation`; the
/// outermost ones stand half a spacing inside the edges. One beam looks straight ahead, also for field_of_view = 0.
BeamFan make_fan(std::size_t beams, double field_of_view, double beam_width, double elevation_width,
                 double elevation = 0);

/// Throws Error unless there is a beam, all angles are finite, |azimuth| <= pi, |elevation| <= pi/2, widths > 0 and
/// row_width is finite and >= 0.
void require_valid(const BeamFan& fan, const char* who);

/// Beams of one elevation.
struct FanRow {
  double elevation = 0;            ///< [rad]
  std::vector<std::size_t> beams;  ///< which of the fan, ascending
};

/// The rows of a fan by ascending elevation; equal means equal to the last bit. A fan in which no two elevations are
/// alike has as many rows as beams.
std::vector<FanRow> fan_rows(const BeamFan& fan);

/// The sector that is sampled: the fan and a margin on either side.
struct Sector {
  double min_azimuth = 0, max_azimuth = 0;      ///< [rad]
  double min_elevation = 0, max_elevation = 0;  ///< [rad]
};
/// azimuth_margin   beyond the outermost beams [rad]; 0: one beam width
Sector insonified_sector(const BeamFan& fan, double elevation_half_extent, double azimuth_margin = 0);

}  // namespace insonify
