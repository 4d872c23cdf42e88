#include <algorithm>
#include <cmath>
#include <limits>

#include "beamforming/synthesis_cost_internal.hpp"
#include "beamforming/windowed_sum_internal.hpp"

namespace insonify {

SynthesisCost::SynthesisCost(const SonarHead& head, const SynthesisChoice& choice, std::size_t tile_bins,
                             bool common_shape) {
  const auto beams = static_cast<double>(head.fan.beams()), elements = static_cast<double>(head.array.elements());
  const auto bins = static_cast<double>(head.gate.bins()), grid = static_cast<double>(choice.grid);
  const auto samples = std::min(static_cast<double>(choice.pulse_samples), bins);
  const double precision = choice.single_precision ? 0.5 : 1, lanes = choice.kernel_width > 8 ? 16 : 8;
  const double width = precision * static_cast<double>(choice.kernel_width);
  const double out_of_cache = choice.bytes_per_thread > 0x100000 ? 7.5 : 0;

  // Transforms, interpolation of beams, and writing them, minus the cost of a silent tile.
  tile = static_cast<double>(tile_bins) *
         (grid * (0.3 * std::log2(grid) + 1.7 * precision + out_of_cache) + beams * (0.31 * width + 4.4));
  gridded_echo = 70 + samples * (precision * lanes + (common_shape ? 0 : 20));
  direct_fixed = beams * (0.32 * elements + 0.3 * bins);
  direct_echo = 0.46 * elements + 20 * samples + beams * (0.39 * samples + 0.9);
  direct_block = 0.37 * static_cast<double>(WindowedSum::block) * beams * elements;
}

bool SynthesisCost::direct_is_cheaper(std::size_t echoes, std::size_t tiles) const {
  const auto n = static_cast<double>(echoes);
  const auto blocks = static_cast<double>((echoes + WindowedSum::block - 1) / WindowedSum::block);
  return direct_fixed + blocks * direct_block + n * direct_echo <= static_cast<double>(tiles) * tile + n * gridded_echo;
}

double SynthesisCost::break_even(std::size_t tiles) const {
  const double extra_per_echo = direct_echo + direct_block / static_cast<double>(WindowedSum::block) - gridded_echo;
  if (extra_per_echo <= 0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, (static_cast<double>(tiles) * tile - direct_fixed) / extra_per_echo);
}

}  // namespace insonify
