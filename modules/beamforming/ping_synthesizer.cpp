#include "beamforming/ping_synthesizer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/gridded_synthesis_internal.hpp"
#include "beamforming/narrow_band/windowed_sum_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/numerics/synthesis_precision_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

/// Least ratio of coherent to incoherent amplitude: cancellation amplifies the error of cut pulses by its inverse.
constexpr double least_kept = 0.25;

}  // namespace

double expected_share(const LineArray& array, double wavelength, std::span<const double> cosines) {
  const auto [low, high] = std::minmax_element(cosines.begin(), cosines.end());
  double squares = 0;
  for (const double w : array.shading) squares += w * w;
  const auto n = static_cast<double>(array.elements());
  const double lobe = wavelength / array.spacing * squares / (n * n);  // integral of the pattern squared over u
  return std::sqrt(lobe / std::max(*high - *low, lobe));
}

/// The synthesis in single or double precision, accurate for images whose share is at least half of `share`.
struct PingSynthesizer::Plan {
  SonarHead head;
  Medium medium;
  SynthesisOptions options;
  double share;
  WindowedSum windowed;
  std::unique_ptr<GriddedSynthesis<float>> in_single;
  std::unique_ptr<GriddedSynthesis<double>> in_double;

  Plan(const SonarHead& head_in, const Medium& medium_in, const SynthesisOptions& options_in, double share_in)
      : head(head_in),
        medium(medium_in),
        options(options_in),
        share(share_in),
        windowed(head, medium, pulse_cut(options.tolerance), options.threads) {
    const double kernel_tolerance = options.tolerance * share;
    if (kernel_tolerance >= single_precision_from)
      in_single = std::make_unique<GriddedSynthesis<float>>(head, medium, options, kernel_tolerance);
    else
      in_double = std::make_unique<GriddedSynthesis<double>>(head, medium, options, kernel_tolerance);
  }
  template <typename EchoesOrCount>
  bool sums_directly(const EchoesOrCount& echoes) const {
    return in_single ? in_single->direct_is_cheaper(echoes) : in_double->direct_is_cheaper(echoes);
  }
  /// The gridded image, unless its error cannot be kept. Where the beams receive a smaller fraction of the gridded
  /// energy than expected, the relative error may exceed the tolerance: again with a kernel of lower tolerance.
  template <typename EchoesOrStream>
  std::optional<ComplexGrid> accurate(const EchoesOrStream& echoes) const {
    GriddedImage image = gridded(echoes);
    if (image.share >= 0.5 * share) return std::move(image.pressure);
    if (options.tolerance * image.share < min_kernel_tolerance) return std::nullopt;
    return Plan(head, medium, options, image.share).gridded(echoes).pressure;
  }
  template <typename EchoesOrStream>
  GriddedImage gridded(const EchoesOrStream& echoes) const {
    return in_single ? in_single->image(echoes) : in_double->image(echoes);
  }
  /// The direct sum with pulses cut at the tolerance, or later if the echoes cancel.
  ComplexGrid summed(const Echoes& echoes) const {
    WindowedImage image = windowed.image(echoes);
    if (image.kept >= least_kept) return std::move(image.pressure);
    const double finer = options.tolerance * image.kept;
    if (finer < min_kernel_tolerance) return synthesize_direct(echoes, head, medium, options);
    return WindowedSum(head, medium, pulse_cut(finer), options.threads).image(echoes).pressure;
  }
};

PingSynthesizer::PingSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  require_synthesis({}, head, medium, options, "PingSynthesizer");
  require_one_row(head, "PingSynthesizer");
  if (!(options.tolerance >= min_gridding_tolerance))
    fail(ErrorKind::argument, "PingSynthesizer: tolerance = ", options.tolerance, ", must be at least ",
         min_gridding_tolerance, "; below that use the direct method");
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  plan_ = std::make_unique<Plan>(head, medium, options, expected_share(head.array, wavelength, beam_cosines(head.fan)));
}

PingSynthesizer::~PingSynthesizer() = default;
PingSynthesizer::PingSynthesizer(PingSynthesizer&&) noexcept = default;
PingSynthesizer& PingSynthesizer::operator=(PingSynthesizer&&) noexcept = default;

SynthesisChoice PingSynthesizer::choice() const {
  SynthesisChoice choice = plan_->in_single ? plan_->in_single->choice() : plan_->in_double->choice();
  choice.share = plan_->share;
  return choice;
}

bool PingSynthesizer::sums_directly(const Echoes& echoes) const { return plan_->sums_directly(echoes); }

ComplexGrid PingSynthesizer::pressure(const Echoes& echoes) const {
  const Plan& plan = *plan_;
  require_synthesis(echoes, plan.head, plan.medium, plan.options, "PingSynthesizer");
  if (plan.sums_directly(echoes)) return plan.summed(echoes);
  if (auto image = plan.accurate(echoes)) return std::move(*image);
  return synthesize_direct(echoes, plan.head, plan.medium, plan.options);
}

ComplexGrid PingSynthesizer::pressure(const EchoStream& stream) const {
  if (stream.stored()) return pressure(*stream.stored());
  if (!plan_->sums_directly(stream.size()))
    if (auto image = plan_->accurate(stream)) return std::move(*image);
  return pressure(all_echoes(stream));
}

SynthesisChoice choice_of_a_row(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  return PingSynthesizer(line_head(head, fan_rows(head.fan).front()), medium, options).choice();
}

ComplexGrid synthesize_gridded(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_gridded");
  require_one_row(head, "synthesize_gridded");
  return PingSynthesizer(head, medium, options).pressure(echoes);
}

}  // namespace insonify
