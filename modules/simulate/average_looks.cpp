#include <complex>
#include <limits>

#include "returns/looks.hpp"
#include "simulate/average_looks_internal.hpp"

namespace insonify {
namespace {

Grid<double> intensity_of(const Ping& ping) { return ping.pressure.cast<std::complex<double>>().abs2(); }

}  // namespace

void average_looks(const PreparedScene& prepared, const ResolvedPing& ping, SimulatedPing& result) {
  const OutputSettings& wanted = ping.options.outputs;
  if (wanted.looks_range == 1 && wanted.looks_pings == 1) return;
  Grid<double> sum = intensity_of(result.ping);
  SimulationOptions pulse = ping.options;
  pulse.outputs = {};
  pulse.detection.threshold_db = std::numeric_limits<double>::infinity();
  for (int k = 1; k < wanted.looks_pings; ++k) {
    pulse.seed += 0x9e3779b97f4a7c15;  // the golden ratio: far from the seeds of other pings
    sum += intensity_of(simulate_ping(prepared, ping.head, ping.view.world_from_head, ping.environment, pulse).ping);
  }
  result.ping.intensity = mean_over_bins(sum / wanted.looks_pings, wanted.looks_range);
}

}  // namespace insonify
