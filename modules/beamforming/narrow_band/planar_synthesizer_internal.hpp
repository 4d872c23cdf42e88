#pragma once
#include <memory>

#include "acoustics/echo_stream.hpp"
#include "beamforming/synthesize.hpp"

namespace insonify {

/// Synthesizes the pressure of a planar array (E56) by gridding in time, u and v at once, to the relative L2 error of the
/// options: as PingSynthesizer, with a kernel over v and a weighted sum over the lines of the grid for each row of beams.
/// Cost: echoes x pulse samples x both kernels' widths, rows x what echoes fill of the grid, and per row and bin the
/// transforms of a line array.
class PlanarSynthesizer {
 public:
  /// Whether `head` is one that can be gridded so: with a column, Gaussian pulses, and a tolerance of at least
  /// min_gridding_tolerance.
  static bool suits(const SonarHead& head, const SynthesisOptions& options);

  PlanarSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options);
  ~PlanarSynthesizer();

  /// Whether so many echoes are gridded; fewer are cheaper row by row.
  bool grids(std::size_t echoes) const;

  /// Returns the image, beams x bins [Pa], of echoes with v, of which none is NaN. Throws Error if some have no v.
  ComplexGrid pressure(const Echoes& echoes) const;
  /// The same of echoes that are made chunk by chunk, of a head and a scene at rest.
  ComplexGrid pressure(const EchoStream& stream) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace insonify
