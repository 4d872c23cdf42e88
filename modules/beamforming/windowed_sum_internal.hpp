#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "acoustics/echoes.hpp"
#include "acoustics/pulse.hpp"
#include "beamforming/sonar_head.hpp"
#include "beamforming/time_axis_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

/// An image, and how far its echoes cancel in it.
struct WindowedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  double kept = 1;       ///< root of its energy over that of all echoes one by one; small if they cancel
};

/// The sum over echoes (E12) with the exact pattern (E10), each over the bins that its pulse reaches: what few echoes
/// are best summed by. An echo's pulse is cut alike in all beams, so what is lost is small wherever it is heard.
/// Cost: echoes x beams x (elements + pulse samples), and one touch of every bin.
class WindowedSum {
 public:
  static constexpr std::size_t block = 32;  ///< echoes whose phasors stay in the nearest cache together

  /// `cut`: pulses end where they fall below this part of their peak. Keeps a reference to `head`.
  WindowedSum(const SonarHead& head, const Medium& medium, double cut, int threads);
  /// Bits do not depend on the number of threads.
  WindowedImage image(const Echoes& echoes) const;

 private:
  struct Work;
  std::size_t echoes_at_once() const;
  void prepare(const Echoes& echoes, std::size_t first, std::size_t last, Work& work) const;
  /// Adds the prepared echoes to some beams; `incoherent`, by beam, takes the energy that they have one by one.
  void add(const Work& work, std::size_t first_beam, std::size_t last_beam, ComplexGrid& pressure,
           std::vector<double>& incoherent) const;

  const SonarHead& head_;
  Medium medium_;
  double cut_;
  int threads_;
  TimeAxis axis_;
  EchoShapes shapes_;
  std::vector<double> u_beam_;
  double step_, first_place_;         ///< phase from element to element per u [rad]; place of the first pair's element
  std::vector<double> weight_;        ///< of each pair of elements that stand opposite
  std::vector<std::uint32_t> terms_;  ///< 0, 1, 2, ...: a cosine and a sine for each pair
};

}  // namespace insonify
