// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "beamforming/numerics/fft_internal.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "core/units.hpp"
#include "sonar/pulse.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Elements of an array with their weights in a beam. Times of a response are relative to the arrival of the echo at
/// `centre`.
struct ArraySection {
  std::vector<double> y;       ///< places [m], positive to port
  std::vector<double> weight;  ///< shading over the number of elements of the whole array
  double centre = 0;           ///< [m]
  /// Weights fade out over this length from `centre`, which is then the end of the array [m]; 0: no fading.
  double fade = 0;

  /// The whole array, about its middle.
  static ArraySection whole(const LineArray& array);
  /// The port end of an array, whose weights fade out over `fade` [m].
  static ArraySection end(const LineArray& array, double fade);
};

/// Sizes that all tables of a part of the array share: the steps of direction and time, and the ranges that one table
/// may span (E134).
struct BeamTableSizes {
  SonarHead head;
  Medium medium;
  double tolerance;
  double widest;  ///< |u| of echoes
  ArraySection section;
  TimeAxis axis;
  PulseReach reach;  ///< half length of an echo's pulse
  EchoShapes shapes;
  double u_beam;
  bool mirrored;            ///< the part receives alike from u and -u: tables hold one side
  double highest;           ///< highest frequency that contributes [Hz]
  double u_step;            ///< between directions of a table
  std::size_t per_bin = 0;  ///< samples of a table per bin of the gate

  /// The bins of a table, and the variable and number of nodes by which it is interpolated between ranges.
  struct Span {
    double first, last;
    std::size_t nodes;
    bool by_inverse;  ///< true: in 1 / range, as wavefronts curve; false: in range, as pulses change

    double position(double range) const { return by_inverse ? 1 / range : range; }
    double range_at(double position) const { return by_inverse ? 1 / position : position; }
  };

  /// Doppler shifts over the carrier. `shifted` is the shift of the tables for moving echoes, `most_shifted` the
  /// largest shift that they serve. Responses are linear in the shift between 0 and most_shifted.
  static constexpr double shifted = 5e-3, most_shifted = 0.025;

  /// For a head with one beam and a Gaussian pulse, and echoes within `widest` of u = 0.
  BeamTableSizes(const SonarHead& head, const Medium& medium, double tolerance, double widest, ArraySection section);

  /// Returns the direction of an echo as seen from the centre of the part, less the direction of the beam's focus at
  /// the echo's range. At a constant value responses hardly change with range. u_seen is the inverse and returns u.
  double seen(double range, double u) const;
  double u_seen(double range, double w) const;
  /// The directions of a table, u_step apart, in values of `seen`.
  struct Directions {
    double first;
    std::size_t count;
  };
  Directions directions_of(const Span& span) const;

  /// Range of a bin of the gate [m].
  double range_of(double bin) const { return 0.5 * medium.sound_speed * (axis.start + bin * axis.step); }
  /// Returns the delay of an echo at the part, less its delay at the middle of the array [s]: the path to the centre of
  /// the part, less the path of a wave from the beam's focus.
  double lateness(double range, double u) const;
  /// Returns the half length of the response to an echo from `near` to `far` [s]: the pulse plus the delays across the
  /// part.
  double half_length(double near, double far) const;
  /// Returns the span of a table that begins at bin `first`: the longest over which polynomials through the nodes keep
  /// the tolerance. The span has two or three nodes if that is long enough, otherwise four.
  Span span_from(double first) const;

 private:
  double path(double range, double u, double time, double y) const;
  double local(double range, double u) const;
  /// Returns the least and the largest value of `seen` of echoes.
  std::array<double, 2> extent(double near, double far) const;
  /// Returns the interpolation error of polynomials through the nodes of a span, relative to the largest response.
  double left_of(const Span& span) const;
  Span longest_span(double first, std::size_t nodes, bool by_inverse) const;
};

/// Table of the responses of one focused beam, or of a part of its array, to echoes of unit amplitude from some bins of
/// the gate (E134). The responses are smooth in 1 / range and direction and limited in band, so polynomials interpolate
/// between the entries. Keeps a reference to its sizes.
class BeamTable {
 public:
  /// Computes every entry as a sum over all elements. `doppler`: shift over the carrier. Directions are relative to the
  /// beam and multiplied by (1 + doppler), which makes the responses almost independent of the shift.
  BeamTable(const BeamTableSizes& sizes, const BeamTableSizes::Span& span, double doppler);

  /// Adds an echo to an image of `bins` bins that begins with bin `first` of the gate. `shifted` is the table for
  /// BeamTableSizes::shifted, or nullptr for an echo at rest; doppler [Hz].
  void add(double delay, double u, std::complex<double> amplitude, double doppler, const BeamTable* shifted,
           std::ptrdiff_t first, std::ptrdiff_t bins, std::complex<double>* image) const;

  /// Bins that a response reaches beyond its echo, to either side.
  static double guard(const BeamTableSizes& sizes, const BeamTableSizes::Span& span);
  /// Number of pulse samples that the construction of a table sums.
  static double work(const BeamTableSizes& sizes, const BeamTableSizes::Span& span);
  /// Size of a table [bytes].
  static double bytes(const BeamTableSizes& sizes, const BeamTableSizes::Span& span);

 private:
  void fill(std::size_t node);
  void write(std::size_t node, std::size_t direction, const double* re, const double* im);
  void find_bins();

  const BeamTableSizes& sizes_;
  double stretch_;     ///< 1 + doppler
  double half_;        ///< length of a response [s]
  std::size_t width_;  ///< bins of a response, filled up
  std::size_t times_;  ///< rows of one direction: time within a bin, and taps
  BeamTableSizes::Span span_;
  BeamTableSizes::Directions directions_;
  std::vector<double> node_, node_weight_;  ///< nodes of range, and the weights of Lagrange's polynomials
  /// Bins [first, last) in which a response is not 0 for some node, time within a bin and one of direction_taps
  /// directions.
  struct Bins {
    std::size_t first, last;  ///< multiples of four; one after the last
  };
  std::vector<Bins> bins_;
  Aligned<float> values_;  ///< responses by range, direction, time within a bin, bin, and real or imaginary part
};

}  // namespace insonify
