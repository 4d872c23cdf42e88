#include <complex>
#include <limits>

#include "returns/looks.hpp"
#include "simulate/average_looks_internal.hpp"

namespace insonify {
namespace {

Grid<double> intensity_of(const Ping& ping) { return ping.pressure.cast<std::complex<double>>().abs2(); }

}  // namespace

void average_looks(const ResolvedPing& resolved, Ping& ping, const std::function<Ping(const ResolvedPing&)>& simulate) {
  const OutputSettings& wanted = resolved.options.outputs;
  if (wanted.looks_range == 1 && wanted.looks_pings == 1) return;
  Grid<double> sum = intensity_of(ping);
  // Only the pressure counts.
  ResolvedPing look = resolved;
  look.options.outputs = {};
  look.detection.threshold_db = std::numeric_limits<double>::infinity();
  for (int k = 1; k < wanted.looks_pings; ++k) {
    look.options.seed += 0x9e3779b97f4a7c15;  // the golden ratio: far from the seeds of other pings
    look.sent.echo_options.seed = look.view.sampling.seed = look.options.seed;
    sum += intensity_of(simulate(look));
  }
  ping.intensity = mean_over_bins(sum / wanted.looks_pings, wanted.looks_range);
}

}  // namespace insonify
