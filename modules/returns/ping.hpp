#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"

namespace insonify {

/// One part of a ping: what came by one kind of path.
struct Layer {
  std::string name;       ///< direct, multipath, volume, surface, bottom, noise
  ComplexGridF pressure;  ///< beams x bins [Pa]
};

/// What one transmission gave.
struct Ping {
  std::int64_t number = 0;
  double time = 0;  ///< of transmission [s]
  Pose world_from_head = Pose::Identity();
  BeamFan fan;
  RangeGate gate;
  ComplexGridF pressure;        ///< beams x bins [Pa], analytic baseband, linear
  std::vector<Layer> layers{};  ///< parts that add up to `pressure`; empty unless they were asked for
  bool expected_level = false;  ///< `pressure` is the root of an expected intensity (E65): no speckle, no phase; layers
                                ///< add up by their squares
  Grid<float> level_error_db{};  ///< of the sampling, beams x bins [dB] (E66), NaN where not judged; or empty
  Grid<std::uint8_t> unknown{};  ///< beams x bins, 1: surface may be missing here, the scan has a hole; or empty
};

/// Pressure as a ping holds it, in single precision. Throws Error(content) naming `who` if a sample does not fit
/// (3.4e38 Pa) or is no number.
ComplexGridF stored_pressure(const ComplexGrid& pressure, const char* who);

/// Level of every sample, beams x bins [dB re 1 uPa rms] (E6); samples below `floor_db` (zeros too) give floor_db.
Grid<float> level_db(const Ping& ping, double floor_db = -200);

/// level_db with spreading and absorption taken back (time-varied gain, E20): + 40 log10(r) + 2 alpha r, re 1 m.
/// A display product: the ping itself stays linear.
Grid<float> range_compensated_level_db(const Ping& ping, double absorption_db_per_m, double floor_db = -200);

/// Mean intensity in dB re 1 uPa over all beams and bins within [min_range, max_range] [m]; -inf if none.
double mean_level_db(const Ping& ping, double min_range, double max_range);

}  // namespace insonify
