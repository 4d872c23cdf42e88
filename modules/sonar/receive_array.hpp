// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>

#include <Eigen/Core>

#include "sonar/sonar_head.hpp"

namespace insonify {

/// A receive array as code outside of it sees it: one file and one row of array_kinds each. A kind states where its
/// elements stand; the rest follows by sums over them (E205), where it has no faster form. Directions are unit vectors.
class ReceiveArray {
 public:
  /// Takes weights and spacing from head.array; `position` in head axes, one for each of its elements [m].
  ReceiveArray(const SonarHead& head, std::vector<Eigen::Vector3d> position);
  virtual ~ReceiveArray() = default;

  /// Throws Error that names `who` unless the array can form the beams of the head.
  virtual void require_valid(const SonarHead& head, const char* who) const = 0;
  /// Returns the evenly spaced line whose beams all have the pattern B(u - u_b), as gridding, tables and split halves
  /// need it; nullptr of an array without.
  virtual const LineArray* line() const { return nullptr; }

  /// Returns the places of the elements; of a planar array those of its middle row [m].
  const std::vector<Eigen::Vector3d>& positions() const { return position_; }
  /// Returns the length of the array across the axis [m]: a lobe is wavelength / length wide in u.
  virtual double length() const;

  /// Returns the phase by which a beam turns element m back, k p_m d for the position p_m and direction d [rad].
  virtual double steering_phase(std::size_t m, const Eigen::Vector3d& beam, double wavelength) const;
  /// Returns the amplitude response of a beam to a plane wave from the direction `from`, 1 along the beam (E205).
  virtual std::complex<double> response(const Eigen::Vector3d& from, const Eigen::Vector3d& beam,
                                        double wavelength) const;
  /// Returns the full -3 dB width in azimuth of the beam straight ahead [rad]; pi if the response stays above.
  virtual double beam_width(double wavelength) const;
  /// Returns true if a beam of the fan receives ahead, beside its main lobe, as loud as within: grating lobes.
  virtual bool has_further_lobes(const BeamFan& fan, double wavelength) const;
  /// Returns by how much in u main lobes bend off their u_b, within `half_extent` of the fan's elevations [rad].
  virtual double bent_by(const BeamFan&, double) const { return 0; }

  /// Returns the directivity index of the beam straight ahead [dB] (E206).
  virtual double directivity_index_db(double wavelength) const;

 protected:
  double spacing_;
  std::vector<double> shading_;

 private:
  std::vector<Eigen::Vector3d> position_;
};

/// Returns the receive array of a head.
std::unique_ptr<const ReceiveArray> receive_array(const SonarHead& head);
/// Returns true if the beams of a head are those of a line or plane (ReceiveArray::line).
bool has_line(const SonarHead& head);
/// Returns the unit vector ahead with the direction cosines u to port and v upwards.
Eigen::Vector3d ahead(double u, double v);
/// Returns the unit vectors of all beams.
std::vector<Eigen::Vector3d> beam_axes(const BeamFan& fan);

}  // namespace insonify
