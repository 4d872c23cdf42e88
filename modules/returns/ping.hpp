// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/motion.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"
#include "returns/pixel_labels.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// One part of a ping: the pressure due to one kind of path or source.
struct Layer {
  std::string name;       ///< direct, multipath, double-echoes, volume, surface, bottom, noise
  ComplexGridF pressure;  ///< beams x bins [Pa]
};

/// Direction of a scanning head: the turn of the head itself, included in the ping's pose.
struct ScanDirection {
  std::int64_t sweep = 0;  ///< number of the sweep, from 0
  double angle = 0;        ///< turn about the head's z axis [rad], positive to port
};

/// Time, pose and water of a ping.
struct TrackPoint {
  std::int64_t number = 0;
  double time = 0;  ///< time of transmission [s]
  Pose world_from_head = Pose::Identity();
  std::optional<ScanDirection> scan{};  ///< for a scanning head; its turn is included in world_from_head
  double sound_speed = 0;               ///< in the water at the head [m/s]; it converts delays to ranges; 0: not known
  double absorption_db_per_m = 0;       ///< absorption of the water at the head, at the centre frequency
  Motion motion{};                      ///< motion of the head from transmission on, as simulated in its echoes
};

/// The result of one transmission.
struct Ping : TrackPoint {
  BeamFan fan;
  RangeGate gate;
  ComplexGridF pressure;        ///< beams x bins [Pa], analytic baseband, linear
  std::vector<Layer> layers{};  ///< parts that add up to `pressure`; empty unless requested
  bool expected_level = false;  ///< true: root of an expected intensity (E65), without phase; squares of layers add up
  bool display_cells = false;   ///< true: bins are display cells: root of the mean intensity over each area, without
                                ///< phase
  Grid<float> intensity{};  ///< mean of |pressure|^2 over the looks of a display, beams x bins [Pa^2] (E71); or empty
  Grid<std::uint8_t> unknown{};  ///< beams x bins, 1 where surface may be missing (a hole of the scan); or empty
  Grid<float>
      split_phase{};     ///< phase between the array's halves [rad], beams x bins, positive to port (E92); or empty
  PixelLabels labels{};  ///< surface of every pixel, if contributors or labels were kept; or empty
};

/// Sets sound speed and absorption of `ping` to those of the water at the head.
void note_water(const Medium& at_head, Ping& ping);

/// Returns the pressure in single precision, as a ping stores it. Throws Error(content) naming `who` if a sample
/// exceeds 3.4e38 Pa or is not a number.
ComplexGridF stored_pressure(const ComplexGrid& pressure, const char* who);
/// Returns the intensities of display cells, mean |pressure|^2 [Pa^2], beams x cells, as a ping stores them: their roots as
/// pressures of phase 0. Throws as stored_pressure.
ComplexGridF stored_cells(const Grid<double>& intensity, const char* who);

/// The level that stands for no sound [dB re 1 uPa rms].
inline constexpr double silence_db = -200;

/// Returns the level of every sample, beams x bins [dB re 1 uPa rms] (E6); samples below `floor_db` (and zeros) give
/// floor_db.
Grid<float> level_db(const Ping& ping, double floor_db = silence_db);

/// Returns level_db compensated for spreading and absorption (time-varied gain, E20): + 40 log10(r) + 2 alpha r, re 1
/// m. For display; the ping itself stays linear.
Grid<float> range_compensated_level_db(const Ping& ping, double absorption_db_per_m, double floor_db = silence_db);

/// Returns the level of the mean intensity [dB re 1 uPa] over all beams and bins within [min_range, max_range] [m];
/// -inf if there are none.
double mean_level_db(const Ping& ping, double min_range, double max_range);

}  // namespace insonify
