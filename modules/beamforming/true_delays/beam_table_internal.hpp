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

/// Elements of an array with the weights that a beam gives them. Responses are counted from an echo's arrival at
/// `centre`.
struct ArrayPart {
  std::vector<double> y;       ///< places [m], positive to port
  std::vector<double> weight;  ///< shading over the number of elements of the whole array
  double centre = 0;           ///< [m]
  /// Weights fade out over this length from `centre`, which is then the end of the array [m]; 0: they do not.
  double fade = 0;

  /// The whole array, about its middle.
  static ArrayPart whole(const LineArray& array);
  /// The port end of an array, whose weights fade out over `fade` [m].
  static ArrayPart end(const LineArray& array, double fade);
};

/// What all tables of a part of the array share: steps of direction and time, and which ranges one table may span
/// (E134).
struct BeamTableSizes {
  SonarHead head;
  Medium medium;
  double tolerance;
  double widest;  ///< |u| of echoes
  ArrayPart part;
  TimeAxis axis;
  PulseReach reach;  ///< half length of an echo's pulse
  EchoShapes shapes;
  double u_beam;
  bool mirrored;            ///< the part receives alike from u and -u: tables hold one side
  double highest;           ///< frequency that counts [Hz]
  double u_step;            ///< between directions of a table
  std::size_t per_bin = 0;  ///< samples of a table per bin of the gate

  /// The bins of a table, and the variable and number of nodes by which it is interpolated between ranges.
  struct Span {
    double first, last;
    std::size_t nodes;
    bool by_inverse;  ///< 1 / range, with which wavefronts bend; else range, with which pulses change

    double place(double range) const { return by_inverse ? 1 / range : range; }
    double range_at(double place) const { return by_inverse ? 1 / place : place; }
  };

  /// Doppler shifts over the carrier: of the tables of moving echoes, and the largest that they are good for. Between,
  /// and as far beyond, responses change linearly with the shift.
  static constexpr double shifted = 5e-3, most_shifted = 0.025;

  /// For a head with one beam and a Gaussian pulse, and echoes within `widest` of u = 0.
  BeamTableSizes(const SonarHead& head, const Medium& medium, double tolerance, double widest, ArrayPart part);

  /// The direction of an echo as the centre of the part sees it, less that of the beam's focus at the echo's range.
  /// Responses change with range little where these are equal. Its inverse gives u.
  double seen(double range, double u) const;
  double u_seen(double range, double w) const;
  /// The directions of a table, u_step apart, as `seen` gives them.
  struct Directions {
    double first;
    std::size_t count;
  };
  Directions directions_of(const Span& span) const;

  /// Range of a bin of the gate [m].
  double range_of(double bin) const { return 0.5 * medium.sound_speed * (axis.start + bin * axis.step); }
  /// By how much later than at the middle of the array an echo counts at the part [s]: its way to the centre of the
  /// part, less that of a wave from the beam's focus.
  double lateness(double range, double u) const;
  /// Half length of a response to an echo from `near` to `far` [s]: the pulse, and what the part's delays add.
  double half_length(double near, double far) const;
  /// The span of a table that begins at bin `first`, as long as polynomials through its nodes keep the tolerance: two or
  /// three nodes if it is long enough, else four.
  Span span_from(double first) const;

 private:
  double path(double range, double u, double time, double y) const;
  double local(double range, double u) const;
  /// The least and the largest direction seen of echoes.
  std::array<double, 2> extent(double near, double far) const;
  /// What polynomials through the nodes of a span leave of responses, relative to the largest.
  double left_of(const Span& span) const;
  Span longest_span(double first, std::size_t nodes, bool by_inverse) const;
};

/// The responses of one focused beam, or of a part of its array, to echoes of unit amplitude from some bins of the
/// gate (E134). They are smooth in 1 / range and direction, and their band is limited, so polynomials between the
/// entries of a table give them. Refers to its sizes.
class BeamTable {
 public:
  /// Sums over all elements for every entry. `doppler`: shift over the carrier. Directions count from the beam, times
  /// (1 + doppler), so that responses hardly depend on it.
  BeamTable(const BeamTableSizes& sizes, const BeamTableSizes::Span& span, double doppler);

  /// Adds an echo to an image of `bins` bins, the first of which is bin `first` of the gate. `shifted`: the same table
  /// for BeamTableSizes::shifted, or nullptr for an echo at rest; doppler [Hz].
  void add(double delay, double u, std::complex<double> amplitude, double doppler, const BeamTable* shifted,
           std::ptrdiff_t first, std::ptrdiff_t bins, std::complex<double>* image) const;

  /// Bins that a response reaches beyond its echo, to either side.
  static double guard(const BeamTableSizes& sizes, const BeamTableSizes::Span& span);
  /// Samples of pulses that a table sums.
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
  std::vector<double> node_, node_weight_;  ///< places of ranges, and what Lagrange's polynomials divide by, inverted
  /// Bins of a response that are not 0 at any node, time within a bin, or of direction_taps directions from one on.
  struct Bins {
    std::size_t first, last;  ///< multiples of four; one after the last
  };
  std::vector<Bins> bins_;
  AlignedFloats values_;  ///< by range, direction, time within a bin, bin, and real or imaginary part
};

}  // namespace insonify
