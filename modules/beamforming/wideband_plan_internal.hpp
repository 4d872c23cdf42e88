#pragma once
#include <cstddef>
#include <vector>

#include "beamforming/gridding_kernel_internal.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "beamforming/time_axis_internal.hpp"

namespace insonify {

/// What the synthesis with true delays has in common for all pings of a head. Time is cut into blocks of bins; the pulses
/// of a block and all that the array's delays make of them fit into one cycle of a transform. Directions lie on a grid
/// over one period, more than twice as wide as the directions of echoes and beams together, so that nothing that a beam
/// hears wraps round. Its harmonics k / period, |k| <= most, are places on the array in wavelengths.
struct WidebandPlan {
  SonarHead head;
  Medium medium;
  double tolerance;
  double widest;  ///< |u| of echoes and beams
  TimeAxis axis;
  double cut;  ///< pulses are cut where they fall below this
  EchoShapes shapes;
  double aperture;       ///< length of the array [m]
  double place_squared;  ///< mean square of an element's place, by the square of its weight [m^2]
  double cubic;          ///< y^3 is nearly cubic y over the array [m^2]

  double half_band = 0;                                         ///< frequencies off the carrier that count [Hz]
  std::size_t block = 0, guard = 0, cycle = 0;                  ///< bins of a block, to either side of it, of a cycle
  std::size_t fine = 0, fine_row = 0;                           ///< samples of a cycle before the beams; room for them
  double fine_step = 0;                                         ///< [s]
  bool one_shape = false;                                       ///< all pulses are alike, but for their level
  double half = 0;                                              ///< of what is gridded of a pulse [s]
  std::size_t pulse_samples = 0;
  PolynomialPieces<float> pulse, columns;

  double period = 0;                           ///< of direction
  std::size_t grid = 0, grid_stride = 0;       ///< steps of the period
  std::size_t most = 0;                        ///< harmonics run from -most to most, one row each
  GriddingKernel kernel{8, 1.5};
  std::vector<float> row_factor;               ///< undoes gridding
  std::vector<float> place;                    ///< square of the place on the array, by row [wavelengths^2]
  std::vector<float> response;                 ///< rows x fine_row: the array's, by harmonic and frequency
  std::vector<float> bend;                     ///< by frequency: phase of a wavefront per square of place and curvature [m]
  std::vector<float> tap;                      ///< harmonics of the curvature's dependence on direction

  WidebandPlan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest);

  std::size_t rows() const { return 2 * most + 1; }
  std::size_t blocks() const { return (axis.bins + 2 * guard + block - 1) / block; }
  /// How many powers of the curvature 1 / r [1/m] count.
  int order(double curvature) const;

 private:
  void plan_time();
  void plan_directions();
  void plan_response(int threads);
  void plan_curvature();
};

}  // namespace insonify
