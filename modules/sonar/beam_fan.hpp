// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"

namespace insonify {

/// Half extent of a main lobe in beam widths: the first null of a Taylor pattern is at 1.25.
inline constexpr double main_lobe_reach = 1.5;

/// Listening directions and widths of the beams of a head, in head axes, one entry per beam.
struct BeamFan {
  std::vector<double> azimuth;    ///< [rad], positive to port; in any order and spacing
  std::vector<double> elevation;  ///< [rad], positive up
  double beam_width = 0;          ///< full -3 dB width in azimuth at broadside [rad]
  double elevation_width = 0;     ///< full -3 dB width in elevation [rad]; for a planar array that of the transmitter
  double row_width = 0;           ///< full -3 dB width in elevation of the beams of a planar array [rad]; 0: line array

  /// Returns the number of beams.
  std::size_t beams() const { return azimuth.size(); }
  bool operator==(const BeamFan&) const = default;
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

/// Returns the beam in the middle: the one of middle bearing in the middle row.
std::size_t middle_beam(const BeamFan& fan);

/// Returns the azimuth at which the cone through `p` (head axes) meets the plane z = 0: asin(u) ahead of the array,
/// pi - asin(u) astern (x < 0) [rad]. A line array resolves u = cos(elevation) sin(azimuth) alone, so a beam is a cone
/// about the array's axis.
double cone_azimuth(const Eigen::Vector3d& p);

/// Returns a direction on a cone, turned by `turn` [rad] about the array's axis, positive upwards; the whole cone lies
/// within +-pi/2. Solid angle: |cos(cone)| dcone dturn.
Direction direction_in_cone(double cone, double turn);

/// Returns the interval of turns [rad], ascending, in which a cone lies within these elevations. Both ends are equal if
/// the cone does not reach these elevations.
std::pair<double, double> turns_between(double cone, double min_elevation, double max_elevation);

/// The insonified sector: directions in which beams have their main lobes.
struct Sector {
  double min_azimuth = 0, max_azimuth = 0;      ///< limits of the cones [rad], see cone_azimuth
  double min_elevation = 0, max_elevation = 0;  ///< [rad]
};
/// Returns the cones of all beams, extended by the margin on either side, and the elevations of all beams, extended by
/// the half extent. It holds only directions ahead (x > 0), unless a beam looks astern.
///
/// margin   in u beyond the outermost beams; 0: 1.5 beam widths, which hold the main lobe of a shaded array
Sector insonified_sector(const BeamFan& fan, double elevation_half_extent, double margin = 0);

/// Returns the interval of azimuth of all directions of a sector [rad]. It exceeds that of its cones if the sector
/// reaches far up or down.
std::pair<double, double> azimuths_of(const Sector& sector);

/// Tests whether a sector holds a position, by signed distances and without trigonometry for each position. All code
/// that tests sectors uses this class.
class SectorBounds {
 public:
  /// Computes the edges of `sector` once.
  explicit SectorBounds(const Sector& sector);

  /// Returns true if a sphere of radius `margin` [m] round p (head axes) may reach into the sector; exact for margin 0.
  bool holds(const Eigen::Vector3d& p, double margin = 0) const {
    return in_elevations(p, margin) && in_cones(p, margin);
  }
  /// Returns the part of holds() that depends on the elevations of the sector.
  bool in_elevations(const Eigen::Vector3d& p, double margin = 0) const {
    const double across = std::sqrt(p.x() * p.x() + p.y() * p.y());
    return p.z() * top_.y() - across * top_.x() <= margin && across * bottom_.x() - p.z() * bottom_.y() <= margin;
  }
  /// Returns the part of holds() that depends on the cones of the sector.
  bool in_cones(const Eigen::Vector3d& p, double margin = 0) const {
    if (whole_circle_) return true;
    // Turn the point about the array's axis into the plane z = 0, ahead or astern, where a cone is a line.
    const double about = std::sqrt(p.x() * p.x() + p.z() * p.z());
    return (p.x() >= -margin && in_plane(about, p.y(), margin)) || (p.x() <= margin && in_plane(-about, p.y(), margin));
  }

 private:
  bool in_plane(double x, double y, double margin) const {
    const bool from_port = port_.x() * x + port_.y() * y >= -margin;
    const bool from_starboard = starboard_.x() * x + starboard_.y() * y >= -margin;
    return convex_ ? from_port && from_starboard : from_port || from_starboard;
  }

  bool whole_circle_, convex_;
  Eigen::Vector2d port_, starboard_;  // inward normals of the edges, in the half-planes through the array's axis
  Eigen::Vector2d top_, bottom_;      // sine and cosine of the edges in elevation
};

}  // namespace insonify
