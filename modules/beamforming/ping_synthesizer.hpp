#pragma once
#include <memory>
#include <string>

#include "acoustics/echoes.hpp"
#include "beamforming/sonar_head.hpp"
#include "beamforming/synthesize.hpp"

namespace insonify {

/// What a PingSynthesizer chose for its tolerance: of gridding, but for direct_echoes.
struct SynthesisChoice {
  bool single_precision = false;  ///< of tiles and transforms; delays and phases are always double
  std::size_t kernel_width = 0;   ///< grid steps over which an echo is spread along the array's dual axis
  std::size_t grid = 0;           ///< grid steps over that axis
  std::size_t pulse_samples = 0;  ///< bins over which a pulse is gridded
  double pulse_half_length = 0;   ///< where it is cut [s]
  std::size_t direct_echoes = 0;  ///< so many echoes, spread over the gate, are summed directly: gridding costs more
  double share = 0;               ///< of what is gridded, expected in a beam: root of a ratio of energies
  double bytes_per_thread = 0;    ///< working memory beside the image
};

/// Complex baseband pressure of many pings of one head, to a promised relative L2 error (E13): each echo grids its pulse,
/// cut at the tolerance, times a spreading kernel (E60) on a grid over direction; per bin an FFT turns the grid into
/// element series, deconvolved and shaded, and back into beams by the same kernel. No transform along range: nothing
/// wraps round, and the error is local, relative to the level at each range.
/// Cost: echoes x pulse samples x kernel width + bins x (grid log grid + beams x kernel width). Where a few echoes cost
/// less summed one by one, with the exact pattern and pulses cut at the tolerance, that is what is done.
/// Errors of the kernel go into all beams alike: for the same tolerance, a fan of many narrow beams needs a wider kernel.
///
/// Made once per head, medium and tolerance; `pressure` is const and may be called from several threads.
class PingSynthesizer {
 public:
  /// Throws Error for an invalid head or medium, a head with several elevations or a column, or a tolerance outside
  /// [1e-13, 1).
  PingSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});
  ~PingSynthesizer();
  PingSynthesizer(PingSynthesizer&&) noexcept;
  PingSynthesizer& operator=(PingSynthesizer&&) noexcept;

  /// beams x bins [Pa]. If the image turns out so weak against its echoes (they cancel, or stand where no beam looks) that
  /// the promise is in doubt, it is made again with more digits. Throws Error for a NaN in an echo, named by its number.
  ComplexGrid pressure(const Echoes& echoes) const;

  SynthesisChoice choice() const;
  /// Whether `pressure` sums these echoes directly: by a model of what either way costs, never by the clock.
  bool sums_directly(const Echoes& echoes) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace insonify
