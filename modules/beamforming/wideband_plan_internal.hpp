#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "beamforming/gridding_kernel_internal.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "beamforming/time_axis_internal.hpp"

namespace insonify {

/// How far the series go that bend wavefronts.
struct WidebandEffort {
  int order = 0;       ///< powers of the curvature
  int fields = 1;      ///< 2: curvatures differ over the block, to first order
  bool cubic = false;  ///< the third order of their distance counts
  double error = 0;    ///< expected, relative
};

/// The array, or where waves are too curved for its length, parts of it: each sees the echoes under their exact range
/// and direction from its own centre.
struct ArrayParts {
  std::vector<std::size_t> first;  ///< element of each part, and one after the last
  std::vector<double> centre;      ///< [m], positive to port
  double aperture = 0;             ///< length of the longest [m]

  ArrayParts(const LineArray& array, std::size_t count);
  std::size_t count() const { return centre.size(); }
};

/// What the synthesis with true delays has in common for all pings of a head. Time is cut into blocks of bins; the
/// pulses of a block and all that the array's delays make of them fit into one cycle of a transform. Directions lie on
/// a grid over one period, more than twice as wide as the directions of echoes and beams together, so that nothing
/// that a beam hears wraps round. Its harmonics k / period, |k| <= most, are places on the array in wavelengths.
struct WidebandPlan {
  SonarHead head;
  Medium medium;
  double tolerance;
  ArrayParts parts;
  double nearest_used;       ///< of echoes [m]
  double widest;             ///< |u| of echoes and beams, as the parts see them
  TimeAxis beam_axis, axis;  ///< of beams; of parts, which hear them earlier or later
  double cut;                ///< pulses are cut where they fall below this
  EchoShapes shapes;
  double cubic = 0;            ///< y^3 is nearly cubic y over the array [m^2]
  double side_lobes = 0;       ///< root of their share of the pattern's energy
  std::vector<double> moment;  ///< root of the mean of y^(4 n), by the square of the shading

  double half_band = 0;                         ///< frequencies off the carrier that count [Hz]
  std::size_t block = 0, guard = 0, cycle = 0;  ///< bins of a block, to either side of it, of a cycle
  std::size_t fine = 0, fine_row = 0;           ///< samples of a cycle before the beams; room for them
  double fine_step = 0;                         ///< [s]
  double pulse_range = 0;                       ///< of the pulse, root of mean square [m]
  bool one_shape = false;                       ///< all pulses are alike, but for their level
  double half = 0;                              ///< of what is gridded of a pulse [s]
  std::size_t pulse_samples = 0;
  PolynomialPieces<float> pulse, columns;

  double period = 0;                      ///< of direction
  std::size_t grid = 0, grid_stride = 0;  ///< steps of the period
  double margin;                          ///< of the period, over which the pattern may end
  std::size_t bend_rows;                  ///< harmonics to which wavefronts may bend what is at the ends of a part
  std::size_t most = 0;                   ///< harmonics run from -most to most, one row each
  GriddingKernel kernel{8, 1.5};
  std::vector<float> row_factor;                     ///< undoes gridding
  std::vector<float> place;                          ///< square of the place on the array, by row [wavelengths^2]
  std::vector<std::vector<float>> response;          ///< of each part: rows x fine_row, by harmonic and frequency
  std::vector<float> squared_wavelength, place_end;  ///< by frequency [m^2]; beyond the array's ends [wavelengths^2]
  std::vector<float> bend;  ///< by frequency: phase of a wavefront per square of place and curvature [m]
  std::vector<float> tap, steep_tap, whole_tap, cubic_tap;  ///< harmonics of the curvature's dependence on direction

  /// `widest`: |u| of echoes and beams; of ranges from `nearest` on [m].
  WidebandPlan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest,
               std::size_t parts = 1, double nearest = 1e9);

  /// When the first bin of a block's cycle is [s].
  double start_of(std::size_t block_number) const {
    return axis.start + (static_cast<double>(block_number * block) - 2 * static_cast<double>(guard)) * axis.step;
  }
  /// Where a direction lies on the grid: the linear part of the third order of its wavefront moves it.
  double column_of(double u, double curvature) const {
    const double moved = u - 0.5 * cubic * u * (1 - u * u) * curvature * curvature;
    return (moved / period + 0.5) * static_cast<double>(grid);
  }
  /// The curvature by which directions are moved: beams of the whole array are moved by the block's, so echoes are too.
  double moving_curvature(double of_block, double of_echo) const { return parts.count() == 1 ? of_block : of_echo; }
  /// The last frequency that counts, to either side of the carrier.
  std::size_t top_line() const { return static_cast<std::size_t>(half_band * static_cast<double>(fine) * fine_step); }
  std::size_t rows() const { return 2 * most + 1; }
  std::size_t blocks() const { return (axis.bins + 2 * guard + block - 1) / block; }
  /// What the wavefronts of a block need that has curvatures 1 / r [1/m] of up to `spread` more or less, relative.
  WidebandEffort effort(double curvature, double spread) const;
  /// The range from which on the series are short and keep the tolerance [m].
  double nearest() const;

 private:
  void plan_moments();
  /// Half the coefficients of f as a sum of cosines, or sines, of multiples of 2 pi u / period, to `error` within the
  /// directions in use; beside them f is held down with the weight `beside`.
  std::vector<float> harmonics(const std::function<double(double)>& f, bool odd, double beside, double error) const;
  void plan_time();
  void plan_directions();
  void plan_response(int threads);
  void plan_curvature();
};

}  // namespace insonify
