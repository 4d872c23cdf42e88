// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/gridded/gridded_engine.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/gridded/gridded_synthesis_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/error.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

/// Parts of the tolerance that gridding over u, there and back, and over v of a planar array may use up.
constexpr double part_of_u = 0.7, part_of_v = 0.5;

/// Least kernel tolerance for which single precision suffices. Errors of kernel and rounding are distributed evenly
/// over all beams, so the kernel tolerance is the image tolerance times the fraction of the gridded energy that the
/// beams receive.
constexpr double single_precision_from = 2e-6;
constexpr double min_kernel_tolerance = 1e-15;

/// Returns the expected GriddedImage::share of an echo among beams in the directions `cosines`: the root mean square of
/// the pattern over the extent of the beams.
double expected_share(const LineArray& array, double wavelength, std::span<const double> cosines) {
  const auto [low, high] = std::minmax_element(cosines.begin(), cosines.end());
  double squares = 0;
  for (const double w : array.shading) squares += w * w;
  const auto n = static_cast<double>(array.elements());
  const double lobe = wavelength / array.spacing * squares / (n * n);  // integral of the pattern squared over u
  return std::sqrt(lobe / std::max(*high - *low, lobe));
}

/// Expected root of the ratio of a beam's energy to that of an echo: over u, and of a planar array over v.
struct ExpectedShare {
  double u, v = 1;

  ExpectedShare(const SonarHead& head, const Medium& medium) {
    const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
    u = expected_share(head.array, wavelength, beam_cosines(head.fan));
    if (!head.column) return;
    std::vector<double> sines;
    for (const FanRow& row : fan_rows(head.fan)) sines.push_back(std::sin(row.elevation));
    v = expected_share(*head.column, wavelength, sines);
  }
};

}  // namespace

/// The synthesis in single or double precision, accurate for images whose share is at least half of that expected.
struct GriddedEngine::Plan {
  SonarHead head;
  Medium medium;
  SynthesisOptions options;
  ExpectedShare share;
  KernelTolerance kernels;
  std::unique_ptr<GriddedSynthesis<float>> in_single;
  std::unique_ptr<GriddedSynthesis<double>> in_double;

  Plan(const SonarHead& head_in, const Medium& medium_in, const SynthesisOptions& options_in)
      : head(head_in), medium(medium_in), options(options_in), share(head, medium), kernels(kernels_for(1)) {
    if (std::min(kernels.u, kernels.v) >= single_precision_from)
      in_single = std::make_unique<GriddedSynthesis<float>>(head, medium, options, kernels);
    else
      in_double = std::make_unique<GriddedSynthesis<double>>(head, medium, options, kernels);
  }
  KernelTolerance kernels_for(double shortfall) const {
    const double tolerance = options.tolerance * shortfall;
    if (!head.column) return {tolerance * share.u, 1};
    return {part_of_u * tolerance * share.u, part_of_v * tolerance * share.v};
  }
  template <typename EchoesOrStream>
  GriddedImage gridded(const EchoesOrStream& echoes) const {
    return in_single ? in_single->image(echoes) : in_double->image(echoes);
  }
  /// The gridded image, unless its error cannot be kept. Where the beams receive a smaller fraction of the gridded
  /// energy than expected, the relative error may exceed the tolerance: again with a lower one.
  template <typename EchoesOrStream>
  std::optional<ComplexGrid> accurate(const EchoesOrStream& echoes) const {
    GriddedImage image = gridded(echoes);
    const double shortfall = image.share / (share.u * share.v);
    if (shortfall >= 0.5) return std::move(image.pressure);
    const KernelTolerance finer = kernels_for(shortfall);
    if (!(std::min(finer.u, finer.v) >= min_kernel_tolerance)) return std::nullopt;
    return Plan(head, medium, {options.tolerance * shortfall, options.threads}).gridded(echoes).pressure;
  }
  /// The direct sum; of a planar array, row by row.
  ComplexGrid summed(const Echoes& echoes) const {
    if (!head.column) return synthesize_direct(echoes, head, medium, options);
    const double cutoff = row_cutoff(options.tolerance, fan_rows(head.fan).size());
    return image_by_rows<ComplexGrid>(
        echoes, head, medium, cutoff, options.threads,
        [&](const Echoes& of_row, const SonarHead& line) { return synthesize_gridded(of_row, line, medium, options); });
  }
};

bool GriddedEngine::suits(const SonarHead& head) {
  return head.column ? is_gaussian(head.pulse) : fan_rows(head.fan).size() == 1 && has_line(head);
}

GriddedEngine::GriddedEngine(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  require_synthesis({}, head, medium, options, "GriddedEngine");
  if (!suits(head)) require_one_row(head, "GriddedEngine");
  if (!(options.tolerance >= min_gridding_tolerance))
    fail(ErrorKind::argument, "GriddedEngine: tolerance = ", options.tolerance, ", must be at least ",
         min_gridding_tolerance, "; below that use the direct method");
  plan_ = std::make_shared<const Plan>(head, medium, options);
}

SynthesisChoice GriddedEngine::choice() const {
  return plan_->in_single ? plan_->in_single->choice() : plan_->in_double->choice();
}

ComplexGrid GriddedEngine::pressure(const Echoes& echoes) const {
  const Plan& plan = *plan_;
  require_synthesis(echoes, plan.head, plan.medium, plan.options, "GriddedEngine");
  if (plan.head.column) require_elevations(echoes);
  if (auto image = plan.accurate(echoes)) return std::move(*image);
  return plan.summed(echoes);
}

ComplexGrid GriddedEngine::pressure(const EchoStream& stream) const {
  if (stream.stored()) return pressure(*stream.stored());
  if (auto image = plan_->accurate(stream)) return std::move(*image);
  return plan_->summed(all_echoes(stream));
}

SynthesisChoice choice_of_a_row(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  return GriddedEngine(line_head(head, fan_rows(head.fan).front()), medium, options).choice();
}

ComplexGrid synthesize_gridded(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_gridded");
  require_one_row(head, "synthesize_gridded");
  return GriddedEngine(head, medium, options).pressure(echoes);
}

}  // namespace insonify
