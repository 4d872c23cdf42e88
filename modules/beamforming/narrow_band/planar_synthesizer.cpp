#include <cmath>
#include <optional>
#include <utility>

#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/image_by_tiles_internal.hpp"
#include "beamforming/narrow_band/planar_synthesizer_internal.hpp"
#include "beamforming/narrow_band/planar_tile_internal.hpp"
#include "beamforming/numerics/synthesis_precision_internal.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/row_echoes_internal.hpp"

namespace insonify {
namespace {

/// Parts of the tolerance that gridding over u, there and back, and over v may use up.
constexpr double part_of_u = 0.7, part_of_v = 0.5;

/// The image by gridding in one precision.
template <typename Real>
class PlanarGridding {
 public:
  PlanarGridding(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, PlanarTolerance kernels)
      : plan_(head, medium, options.tolerance, kernels),
        threads_(options.threads),
        transform_(plan_.across),
        tiles_([this] { return std::make_unique<PlanarTile<Real>>(plan_); }) {}

  GriddedImage image(const Echoes& echoes) const {
    require_elevations(echoes);
    const GriddingPlan<Real>& across = plan_.across;
    const GriddingInput input{echoes, reach(), false, gridding_unit(echoes, across.medium, threads_)};
    return stored_image(input, across, tiles_, threads_, former());
  }
  GriddedImage image(const EchoStream& stream) const {
    return streamed_image(stream, plan_.across, tiles_, reach(), 1, threads_, former());
  }

 private:
  PulseReach reach() const {
    const GriddingPlan<Real>& across = plan_.across;
    return {across.head.pulse, across.medium.absorption, across.medium.sound_speed, false, across.cut};
  }
  auto former() const {
    return [this](PlanarTile<Real>& tile, double unit, std::size_t first, std::size_t last, ComplexGrid& pressure) {
      return tile.form_beams(transform_, unit, first, last, pressure);
    };
  }

  PlanarPlan<Real> plan_;
  int threads_;
  BeamTransform<Real> transform_;
  mutable TilePool<PlanarTile<Real>> tiles_;
};

std::vector<double> row_sines(const BeamFan& fan) {
  std::vector<double> v;
  for (const FanRow& row : fan_rows(fan)) v.push_back(std::sin(row.elevation));
  return v;
}

}  // namespace

/// The synthesis in single or double precision, accurate for images whose share is at least half of `share`.
struct PlanarSynthesizer::Plan {
  SonarHead head;
  Medium medium;
  SynthesisOptions options;
  PlanarTolerance share;  // of each direction
  std::size_t direct_echoes;
  std::unique_ptr<PlanarGridding<float>> in_single;
  std::unique_ptr<PlanarGridding<double>> in_double;

  Plan(const SonarHead& head_in, const Medium& medium_in, const SynthesisOptions& options_in, PlanarTolerance share_in,
       std::size_t direct)
      : head(head_in), medium(medium_in), options(options_in), share(share_in), direct_echoes(direct) {
    const PlanarTolerance kernels{part_of_u * options.tolerance * share.u, part_of_v * options.tolerance * share.v};
    if (std::min(kernels.u, kernels.v) >= single_precision_from)
      in_single = std::make_unique<PlanarGridding<float>>(head, medium, options, kernels);
    else
      in_double = std::make_unique<PlanarGridding<double>>(head, medium, options, kernels);
  }

  template <typename EchoesOrStream>
  GriddedImage gridded(const EchoesOrStream& echoes) const {
    return in_single ? in_single->image(echoes) : in_double->image(echoes);
  }
  /// The gridded image, unless its error cannot be kept: where the beams receive a smaller fraction of the gridded
  /// energy than expected, again with kernels of lower tolerance.
  template <typename EchoesOrStream>
  std::optional<ComplexGrid> accurate(const EchoesOrStream& echoes) const {
    GriddedImage image = gridded(echoes);
    const double shortfall = image.share / (share.u * share.v);
    if (shortfall >= 0.5) return std::move(image.pressure);
    const PlanarTolerance finer{share.u * shortfall, share.v * shortfall};
    if (part_of_v * options.tolerance * std::min(finer.u, finer.v) < min_kernel_tolerance) return std::nullopt;
    return Plan(head, medium, options, finer, direct_echoes).gridded(echoes).pressure;
  }
  ComplexGrid by_rows(const Echoes& echoes) const {
    const double cutoff = row_cutoff(options.tolerance, fan_rows(head.fan).size());
    return image_by_rows<ComplexGrid>(
        echoes, head, medium, cutoff, options.threads,
        [&](const Echoes& of_row, const SonarHead& line) { return synthesize_gridded(of_row, line, medium, options); });
  }
};

bool PlanarSynthesizer::suits(const SonarHead& head, const SynthesisOptions& options) {
  return head.column && head.pulse.shape == PulseShape::gaussian && options.tolerance >= min_gridding_tolerance;
}

PlanarSynthesizer::PlanarSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  // As many as a row of beams would rather sum.
  const std::size_t direct = choice_of_a_row(head, medium, options).direct_echoes;
  plan_ = std::make_unique<Plan>(head, medium, options,
                                 PlanarTolerance{expected_share(head.array, wavelength, beam_cosines(head.fan)),
                                                 expected_share(*head.column, wavelength, row_sines(head.fan))},
                                 direct);
}

PlanarSynthesizer::~PlanarSynthesizer() = default;

bool PlanarSynthesizer::grids(std::size_t echoes) const { return echoes > plan_->direct_echoes; }

ComplexGrid PlanarSynthesizer::pressure(const Echoes& echoes) const {
  if (grids(echoes.size()))
    if (auto image = plan_->accurate(echoes)) return std::move(*image);
  return plan_->by_rows(echoes);
}

ComplexGrid PlanarSynthesizer::pressure(const EchoStream& stream) const {
  if (stream.stored()) return pressure(*stream.stored());
  if (grids(stream.size()))
    if (auto image = plan_->accurate(stream)) return std::move(*image);
  return plan_->by_rows(all_echoes(stream));
}

}  // namespace insonify
