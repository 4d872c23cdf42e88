#pragma once
#include <memory>

#include "acoustics/echoes.hpp"
#include "beamforming/sonar_head.hpp"
#include "beamforming/synthesize.hpp"

namespace insonify {

/// Complex baseband pressure of many pings of one head as its elements receive it: with true delays, focused at every
/// range (E61, E62), whatever the band, to a relative L2 error below the tolerance (E68). What element_series and
/// beam_from_elements give, at about the cost of gridding:
///
///   1. Time is cut into blocks; each echo belongs to one. Its pulse, sampled as finely as its band needs, is gridded
///      over direction, as PingSynthesizer does.
///   2. Transforms over direction and time turn a block into harmonics (places on the array in wavelengths) and
///      frequencies. What the array does there to plane waves is one real factor each, planned once.
///   3. The bend of wavefronts is a short series in powers of a filter along the harmonics, for echoes and, undone, for
///      beams; longer the nearer the block. Echoes that differ too much in range within a block are taken apart.
///   4. Back in time, at the bins, and in direction; beams are interpolated. Blocks overlap by what the array's delays
///      and pulses reach; what lies in another block than that and its neighbours never changes a bin.
///   5. Near echoes, for which that series would be long, are received by 2, 4, 8 ... parts of the array, for which
///      they are far. Each part has its own exact range and direction of every echo and of every bin of a beam; its
///      image is interpolated in direction and time.
///
/// Cost: far off, 3 to 4 times that of PingSynthesizer. It grows with the number of parts: about 15 times at 40 lengths
/// of the array, 30 times at 8 lengths. Echoes nearer than the parts reach (at most some two thirds of the array's
/// length for 1e-3) are summed element by element, which is slow.
/// Error: tested against element_exact at 1e-2, 1e-3 and 1e-4 for ten small heads, down to one length of the array;
/// below 1e-4 it is not tested. Relative to the level of a block. Transforms are single precision, and errors go into
/// all beams alike: an image that receives only side lobes of its echoes (one echo between the beams of a sparse fan)
/// is good to the tolerance times what the beams beside would receive. Sweeps have no sharp band: held by a test at
/// 1e-2.
///
/// Made once per head, medium and tolerance; `pressure` is const and may be called from several threads.
class WidebandSynthesizer {
 public:
  /// Throws Error for an invalid head or medium, a head with several elevations or a column, or a tolerance outside
  /// [1e-5, 0.1].
  WidebandSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});
  ~WidebandSynthesizer();
  WidebandSynthesizer(WidebandSynthesizer&&) noexcept;
  WidebandSynthesizer& operator=(WidebandSynthesizer&&) noexcept;

  /// beams x bins [Pa]; the bits do not depend on the number of threads. Throws Error for a NaN in an echo, named by
  /// its number.
  ComplexGrid pressure(const Echoes& echoes) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// A WidebandSynthesizer made for this one image. Throws Error as it does.
ComplexGrid synthesize_true_delays(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const SynthesisOptions& options = {});

}  // namespace insonify
