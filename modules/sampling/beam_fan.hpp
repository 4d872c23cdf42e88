#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// Listening directions and widths of the beams of a head, in head axes, one entry per beam.
struct BeamFan {
  std::vector<double> azimuth;    ///< [rad], positive to port; in any order and spacing
  std::vector<double> elevation;  ///< [rad], positive up
  double beam_width = 0;          ///< full -3 dB width in azimuth at broadside [rad]
  double elevation_width = 0;     ///< full -3 dB width in elevation [rad]; for a planar array that of the transmitter
  double row_width = 0;           ///< full -3 dB width in elevation of the beams of a planar array [rad]; 0: line array

  std::size_t beams() const { return azimuth.size(); }
};

/// Returns a fan of `beams` directions equally spaced in azimuth over `field_of_view` [rad], centred on azimuth 0, at
/// elevation `elevation` [rad]; the outermost beams are half a spacing inside the edges. A single beam points straight
/// ahead and may have field_of_view 0. Throws Error for beams = 0 or invalid angles and widths.
BeamFan make_fan(std::size_t beams, double field_of_view, double beam_width, double elevation_width,
                 double elevation = 0);

/// Throws Error unless there is at least one beam, all angles are finite, |azimuth| <= pi, |elevation| <= pi/2, widths
/// are > 0, and row_width is finite and >= 0. `who` names the caller.
void require_valid(const BeamFan& fan, const char* who);

/// The beams of one elevation.
struct FanRow {
  double elevation = 0;            ///< [rad]
  std::vector<std::size_t> beams;  ///< indices into the fan, ascending
};

/// Returns the rows of a fan by ascending elevation. Elevations must be equal to the last bit to form one row, so a fan
/// with all elevations different has as many rows as beams.
std::vector<FanRow> fan_rows(const BeamFan& fan);

/// The sampled sector: the fan plus a margin on each side.
struct Sector {
  double min_azimuth = 0, max_azimuth = 0;      ///< [rad]
  double min_elevation = 0, max_elevation = 0;  ///< [rad]
};
/// Returns the insonified sector of a fan.
///
/// elevation_half_extent   margin below the lowest and above the highest beam [rad]
/// azimuth_margin          margin beyond the outermost beams [rad]; 0: one beam width
Sector insonified_sector(const BeamFan& fan, double elevation_half_extent, double azimuth_margin = 0);

}  // namespace insonify
