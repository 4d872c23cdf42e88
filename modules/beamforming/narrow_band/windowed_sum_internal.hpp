#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "core/grid.hpp"
#include "sonar/pulse.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// An image, and the degree to which its echoes cancel.
struct WindowedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  double kept = 1;       ///< root of the ratio of its energy to the sum of the echoes' energies; small if they cancel
};

/// Direct sum over echoes (E12) with the exact pattern (E10), each over the bins that its pulse overlaps; the cheapest
/// method for few echoes. Each pulse is cut alike in all beams, so the relative error is the same in every beam that
/// receives it. Cost: echoes x beams x (elements + pulse samples), plus one pass over all bins.
class WindowedSum {
 public:
  static constexpr std::size_t block = 32;  ///< echoes per block; their phasors fit into the first-level cache

  /// cut   fraction of the peak below which pulses are cut
  ///
  /// Keeps a reference to `head`.
  WindowedSum(const SonarHead& head, const Medium& medium, double cut, int threads);
  /// The bits of the result do not depend on the number of threads.
  WindowedImage image(const Echoes& echoes) const;

 private:
  struct Work;
  std::size_t echoes_at_once() const;
  void prepare(const Echoes& echoes, std::size_t first, std::size_t last, Work& work) const;
  /// Adds the prepared echoes to beams [first_beam, last_beam); `incoherent` accumulates per beam the sum of their
  /// energies.
  void add(const Work& work, std::size_t first_beam, std::size_t last_beam, ComplexGrid& pressure,
           std::vector<double>& incoherent) const;

  const SonarHead& head_;
  Medium medium_;
  double cut_;
  int threads_;
  TimeAxis axis_;
  EchoShapes shapes_;
  std::vector<double> u_beam_;
  double step_, first_place_;   ///< phase between elements per unit of u [rad]; position of the first pair's element
  std::vector<double> weight_;  ///< weight of each symmetric pair of elements
  std::vector<std::uint32_t> terms_;  ///< 0, 1, 2, ...: a cosine and a sine per pair
};

}  // namespace insonify
