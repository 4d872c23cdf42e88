#pragma once
#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/wideband_array_internal.hpp"
#include "beamforming/wideband_plan_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

constexpr std::size_t wideband_tile = 32;          ///< samples that are turned into harmonics at once
constexpr std::size_t wideband_tile_row = 32 + 8;  ///< numbers from one grid step to the next

/// The transforms of a plan.
struct WidebandTransforms {
  FftAlongRows<float> to_harmonics, to_directions, to_frequencies, to_bins, to_samples;

  explicit WidebandTransforms(const WidebandPlan& plan);
};

/// Echoes as a part of the array sees them.
struct SeenEchoes {
  Echoes echoes;                  ///< delays and directions at the part's centre; amplitudes turned by the extra path
  std::vector<double> path;       ///< delay at the array's centre, from which absorption follows [s]
  std::vector<double> curvature;  ///< of wavefronts, 1 / range from the part [1/m]
};

/// Echoes as the plan's part number `part` sees them (E61).
SeenEchoes seen_by(const Echoes& echoes, const WidebandPlan& plan, std::size_t part);

/// The echoes of one block, and their place in time and range.
struct WidebandBlock {
  std::size_t part, number;
  std::span<const std::uint32_t> list;  ///< echoes, by time
  double curvature;                     ///< 1 / range about which wavefronts are bent [1/m]
  double unit;                          ///< what is gridded is counted in this [Pa]
  WidebandEffort effort;
};

/// Room of one thread for one block.
class WidebandRoom {
 public:
  WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms);

  /// The beams of a block, in `pressure`: added within `ends` bins of either end of its cycle, else overwritten; of a
  /// part of the array, always added.
  void image(const SeenEchoes& seen, const WidebandBlock& block, std::size_t ends, ComplexGrid& pressure);

 private:
  using Complex = std::complex<float>;

  /// `excess`: weighted by how much an echo's curvature exceeds that of the block.
  void grid_echoes(const SeenEchoes& seen, const WidebandBlock& block, bool excess);
  void grid_alike(const SeenEchoes& seen, const WidebandBlock& block, bool excess);
  void grid_singly(const SeenEchoes& seen, const WidebandBlock& block, bool excess);
  void to_frequencies(WidebandSpectrum& spectrum);
  void to_bins(WidebandSpectrum& spectrum, WidebandSpectrum& bins);
  void add_excess(const WidebandBlock& block);
  void to_beams(const WidebandBlock& block, std::size_t ends, ComplexGrid& pressure);
  void steer(double curvature);
  void to_samples(WidebandSpectrum& spectrum, WidebandSpectrum& samples);
  void add_part(const WidebandBlock& block, ComplexGrid& pressure);

  const WidebandPlan& plan_;
  const WidebandTransforms& transforms_;
  WidebandArray array_;
  AlignedArray<float, float> re_, im_;  ///< fine samples x grid_stride
  WidebandSpectrum tile_, spectrum_, bins_;
  std::unique_ptr<WidebandSpectrum> excess_spectrum_, excess_bins_;  ///< of a second field
  std::unique_ptr<WidebandSpectrum> samples_, excess_samples_;       ///< of a part: directions x fine_row
  std::vector<float> scratch_, excess_;
  std::vector<float> beam_weight_;
  std::vector<std::uint32_t> beam_row_;
  std::vector<double> pulse_re_, pulse_im_;
  std::vector<bool> touched_;  ///< tiles of fine samples that hold anything
  std::size_t bins_row_;
};

}  // namespace insonify
