// Adaptive sampling. Each sampling is judged by the predicted standard error of every cell's expected level (E66). The
// error falls with the root of the number of points: the next sampling has more of them by the square of the ratio of
// errors, until 99 % of the cells are below the wanted error. Each round costs one sampling and two intensity images.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "sampling/visible_surfels.hpp"
#include "simulate/converge_sampling_internal.hpp"

namespace insonify {
namespace {

constexpr double wanted_share = 0.99;
constexpr int most_samplings = 6;
constexpr double most_points = 1 << 23;             // scatterers, or rays cast
constexpr double least_step = 1.3, most_step = 16;  // of the number of points, from one sampling to the next

/// Finds the share of the judged cells below the wanted error, and the error that the wanted share is below.
void judge(ConvergenceReport& report) {
  std::vector<float> errors;
  for (Eigen::Index k = 0; k < report.level_error_db.size(); ++k)
    if (const float error = report.level_error_db.data()[k]; !std::isnan(error)) errors.push_back(error);
  report.judged = errors.size();
  report.share_below = 1;
  report.reached_db = 0;
  if (errors.empty()) return;
  const auto below = std::count_if(errors.begin(), errors.end(), [&](float e) { return e < report.wanted_db; });
  report.share_below = static_cast<double>(below) / static_cast<double>(errors.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(wanted_share * static_cast<double>(errors.size()))) - 1;
  std::nth_element(errors.begin(), errors.begin() + rank, errors.end());
  report.reached_db = errors[static_cast<std::size_t>(rank)];
}

/// Factor by which the next sampling should have more points; below `least_step` another sampling is not worth it.
double next_step(const ConvergenceReport& report, double points) {
  const double needed = 1.1 * std::pow(report.reached_db / report.wanted_db, 2);  // sigma falls with the root
  return std::min(std::clamp(needed, least_step, most_step), most_points / std::max(points, 1.0));
}

void refine(SamplingOptions& sampling, double step) {
  if (sampling.kind == SamplingKind::rays)
    sampling.rays_per_beam = static_cast<int>(std::ceil(sampling.rays_per_beam * step));
  else
    sampling.scatterers_per_cell = std::max(1.0, sampling.scatterers_per_cell) * step;
}

Sampling sample_once(const PreparedScene& prepared, const View& view) {
  if (view.sampling.kind == SamplingKind::rays)
    return find_scatterers(prepared, view.world_from_head, view.fan, view.gate, view.sampling);
  const VisibleSurfels visible = find_visible(prepared, view.world_from_head, view.fan, view.gate, view.sampling);
  return {make_parts(prepared.scene(), view.world_from_head, visible), visible.report};
}

Sampling converge_sampling(const PreparedScene& prepared, ResolvedPing& ping, ConvergenceReport& report) {
  const Transmission& sent = ping.sent;
  SamplingOptions& sampling_options = ping.view.sampling;
  EchoOptions mean_power = sent.echo_options;
  mean_power.amplitude = SurfaceAmplitude::mean_power;
  while (true) {
    Sampling sampling = sample_once(prepared, ping.view);
    const Echoes echoes =
        direct_echoes(sampling.scatterers, prepared.scene().materials, sent.pulse, sent.medium, mean_power);
    report.level_error_db =
        predict_level_error_db(echoes, ping.head, sent.medium, {.threads = ping.options.threads});  // (E66)
    report.scatterers = sampling.scatterers.size();
    report.scatterers_per_cell = sampling_options.scatterers_per_cell;
    report.rays_per_beam = sampling_options.rays_per_beam;
    ++report.samplings;
    judge(report);
    const double rays = static_cast<double>(report.rays_per_beam) * static_cast<double>(ping.head.fan.beams());
    const double step =
        next_step(report, sampling_options.kind == SamplingKind::rays ? rays : static_cast<double>(report.scatterers));
    report.reached = report.share_below >= wanted_share;
    if (report.reached || report.samplings == most_samplings || step < least_step) return sampling;
    refine(sampling_options, step);
  }
}

}  // namespace

Sampling sample_view(const PreparedScene& prepared, ResolvedPing& ping, ConvergenceReport& report) {
  report.wanted_db = ping.options.sampling.level_error_db;
  return report.wanted_db == 0 ? sample_once(prepared, ping.view) : converge_sampling(prepared, ping, report);
}

std::vector<std::string> convergence_notes(const ConvergenceReport& report) {
  if (report.reached || report.samplings == 0) return {};
  std::ostringstream note;
  note.precision(3);
  note << "level error: " << 100 * report.share_below << " % of the cells are below the " << report.wanted_db
       << " dB asked for, 99 % are below " << report.reached_db << " dB: stopped after " << report.samplings
       << " samplings at " << report.scatterers
       << " scatterers; ask for a larger error, a smaller range gate or fewer beams";
  return {note.str()};
}

}  // namespace insonify
