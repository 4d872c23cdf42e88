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
#include "returns/soundings.hpp"
#include "sampling/find_scatterers.hpp"
#include "simulate/simulation_options.hpp"

namespace insonify {

/// Wall time of each stage [s].
struct StageSeconds {
  double sampling = 0, acoustics = 0, synthesis = 0, detection = 0, contributors = 0;
};

/// What refraction does to this scene.
struct RefractionReport {
  RefractionBound bound;     ///< what straight rays are off by, at most of some 1000 scatterers in view
  bool bent = false;         ///< the scatterers stand where they seem to be
  std::size_t silenced = 0;  ///< scatterers in a shadow zone
};

/// How many echoes each layer was made of.
struct LayerReport {
  std::string name;
  std::size_t echoes = 0;
};

/// How much of the scene is not known (find_holes).
struct HoleReport {
  std::size_t directions = 0;  ///< looked at; 0: none
  std::size_t unknown = 0;     ///< of these, into a hole of the scan
};

/// What OutputSettings asks for; the rest is empty.
struct PingOutputs {
  Scatterers scatterers;
  ElementSeries elements;
  SoundPaths paths;
  Contributors contributors;
};

/// What a ping was made of, and how.
struct PingReport {
  SimulationOptions options;  ///< as they were decided: nothing is left as needed
  Medium medium;              ///< water at the head's depth, with the absorption that was used
  SamplingReport sampling;
  RefractionReport refraction;
  HoleReport holes;
  std::vector<LayerReport> layers;  ///< in the order in which they were added
  double noise_floor_db = 0;        ///< of a beam, used by the detection [dB re 1 uPa]
  StageSeconds seconds;
  std::vector<std::string> notes;  ///< what limits this ping's accuracy, one sentence each with a remedy
};

/// A ping: levels and phases, points, what else was asked for, and how it came about.
struct SimulatedPing {
  Ping ping;
  Soundings soundings;
  PingOutputs outputs;
  PingReport report;
};

}  // namespace insonify
