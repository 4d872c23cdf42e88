// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "acoustics/sound_paths.hpp"
#include "acoustics/sound_speed_profile.hpp"
#include "beamforming/reference/element_series.hpp"
#include "returns/contributors.hpp"
#include "returns/ping.hpp"
#include "returns/ping_note.hpp"
#include "returns/soundings.hpp"
#include "sampling/find_scatterers.hpp"
#include "simulate/simulation_options.hpp"

namespace insonify {

/// Wall time of each stage [s].
struct StageSeconds {
  double sampling = 0, acoustics = 0, synthesis = 0, detection = 0, contributors = 0;
};

/// Effect of refraction on this scene.
struct RefractionReport {
  RefractionBound bound;      ///< error of straight rays, from at most some 1000 scatterers in view
  bool bent = false;          ///< true: the scatterers are at their apparent positions
  RefractedPaths paths;       ///< scatterers that no ray reaches, or too many
  std::size_t unreached = 0;  ///< legs of echoes by boundaries, mirrors and two surfaces that no ray has
};

/// Number of echoes in a layer.
struct LayerReport {
  std::string name;
  std::size_t echoes = 0;
};

/// Counts of directions into holes of the scan (find_holes).
struct HoleReport {
  std::size_t directions = 0;  ///< directions examined; 0: none
  std::size_t unknown = 0;     ///< examined directions into a hole of the scan
};

/// The outputs that OutputSettings asks for; all others are empty.
struct PingOutputs {
  Scatterers scatterers;
  ElementSeries elements;
  SoundPaths paths;
  Contributors contributors;
};

/// Report of a simulated ping: decisions, medium, counts, times and notes.
struct PingReport {
  SimulationOptions options;  ///< with all effects decided: none is as_needed
  Medium medium;              ///< water at the head's depth, with the absorption that was used
  SamplingReport sampling;
  RefractionReport refraction;
  HoleReport holes;
  std::vector<LayerReport> layers;  ///< in the order in which they were added
  double noise_floor_db = 0;        ///< noise level of a beam, used by the detection [dB re 1 uPa]
  StageSeconds seconds;
  std::vector<PingNote> notes;  ///< what limits the accuracy of this ping
};

/// The result of a simulation: the ping, its soundings, the outputs asked for, and the report.
struct SimulatedPing {
  Ping ping;
  Soundings soundings;
  PingOutputs outputs;
  PingReport report;
};

}  // namespace insonify
