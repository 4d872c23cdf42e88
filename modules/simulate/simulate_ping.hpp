#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "acoustics/bend_paths.hpp"
#include "acoustics/environment.hpp"
#include "acoustics/sound_paths.hpp"
#include "beamforming/kept_synthesizers.hpp"
#include "beamforming/reference/element_series.hpp"
#include "returns/contributors.hpp"
#include "returns/ping.hpp"
#include "scene/prepared_scene.hpp"
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_head.hpp"

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

/// How the sampling was refined for SamplingSettings::level_error_db.
struct ConvergenceReport {
  double wanted_db = 0;            ///< 0: it was not refined
  int samplings = 0;               ///< number of samplings made
  double scatterers_per_cell = 0;  ///< at the last
  int rays_per_beam = 0;           ///< at the last, of rays
  std::size_t scatterers = 0;      ///< at the last
  std::size_t judged = 0;          ///< cells within 40 dB of the strongest
  double share_below = 0;          ///< of these, below wanted_db
  double reached_db = 0;           ///< 99 % of them are at or below
  bool reached = false;
  Grid<float> level_error_db{};  ///< of each cell, beams x bins; moved to the ping
};

/// How much of the scene is not known (find_holes).
struct HoleReport {
  std::size_t directions = 0;  ///< looked at; 0: none
  std::size_t unknown = 0;     ///< of these, into a hole of the scan
};

/// A ping, what it was made of, and how.
struct SimulatedPing {
  Ping ping;
  Scatterers scatterers;  ///< if they were asked for
  Soundings soundings;
  SamplingReport sampling;
  Medium medium;
  RefractionReport refraction;
  ConvergenceReport convergence;
  HoleReport holes;
  ElementSeries elements;           ///< if they were asked for
  SoundPaths paths;                 ///< if they were asked for
  Contributors contributors;        ///< if they were asked for; else empty
  std::vector<LayerReport> layers;  ///< in the order in which they were added
  double noise_floor_db = 0;        ///< of a beam, used by the detection [dB re 1 uPa]
  StageSeconds seconds;
  std::vector<std::string> notes{};  ///< what limits this ping's accuracy, one sentence each with a remedy
};

/// One ping: the whole signal path. Start reading here. What the options leave as needed is computed where the plan of
/// the ping (plan_ping) needs it for options.accuracy_db; what the environment does not hold is not. The result does
/// not depend on the thread count. Throws Error for an invalid scene, head, pose,
/// environment or option, named in the message; options are checked before any work.
///
/// kept   of many pings of the same heads: what forms their beams is made once and left there; same bytes
SimulatedPing simulate_ping(const PreparedScene& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {},
                            KeptSynthesizers* kept = nullptr);

/// The same, with the scene prepared for this one ping: the same bytes. For many pings of a scene, prepare it once.
SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {},
                            KeptSynthesizers* kept = nullptr);

}  // namespace insonify
