#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "acoustics/bend_paths.hpp"
#include "acoustics/direct_echoes.hpp"
#include "acoustics/environment.hpp"
#include "acoustics/motion.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "acoustics/sound_paths.hpp"
#include "beamforming/element_series.hpp"
#include "beamforming/synthesize.hpp"
#include "returns/contributors.hpp"
#include "returns/detect_soundings.hpp"
#include "returns/ping.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// Whether something is done: as the scene needs it, always, or never.
enum class Choice { as_needed, always, never };

struct SimulationOptions {
  std::uint64_t seed = 1;
  SamplingKind sampling = SamplingKind::surfels;
  double scatterers_per_cell = 10;
  int rays_per_beam = 64;
  bool occlusion = true;
  SurfaceAmplitude amplitude = SurfaceAmplitude::complex_normal;
  /// `incoherent` gives the expected level without speckle (E65): all amplitudes are of mean power, and layers and noise
  /// add up by their squares. There is nothing for elements to hear then.
  SynthesisMethod method = SynthesisMethod::gridded;
  double tolerance = 1e-4;
  /// Sampling is refined until 99 % of the cells have a smaller error (E66); 0: taken as it is.
  double level_error_db = 0;
  bool multipath = false;    ///< adds echoes by way of the environment's surface and bottom (E48)
  bool noise = false;        ///< adds thermal, wind and self noise of independent elements (E18, E25, E41)
  Motion motion{};           ///< of the head during the ping (E44); boundaries and water are heard as at rest
  int absorption_order = 0;  ///< 0: absorption of the centre frequency for the whole pulse
  Choice refraction = Choice::as_needed;  ///< bends rays by the environment's profile (E43)
  double elevation_floor_db = -40;        ///< elevations where the two-way pattern is lower are not sampled
  double azimuth_margin = 0;              ///< sampled beyond the outermost beams, in u; 0: 1.5 beam widths
  DetectionOptions detection{};           ///< noise floor -inf: all noise in the band, less the array's gain
  std::int64_t ping = 0;                  ///< number of the ping: noise, water and waves are new in every one
  double time = 0;                        ///< of transmission [s]
  /// What to keep beside the ping. keep_elements: what every element of a line array hears, before beams (E61), without
  /// noise; keep_layers: each kind of echo as a layer of its own; keep_mask: the cells where the scan has holes; keep_paths:
  /// so many paths of sound of each kind; keep_contributors: so many of the strongest surfels of every pixel (E63), <= 255.
  bool keep_elements = false, keep_layers = false, keep_mask = false;
  int keep_paths = 0, keep_contributors = 0;
  int threads = 0;  ///< 0: all cores; the result does not depend on it
};

/// Wall time of each stage [s].
struct StageSeconds {
  double sampling = 0, acoustics = 0, synthesis = 0, detection = 0, contributors = 0;
};

/// What refraction does to this scene. Rays are bent only when the error of straight ones would reach a range bin, or 2 %
/// of the elevation width.
struct RefractionReport {
  RefractionBound bound;     ///< of leaving refraction out
  bool bent = false;         ///< the scatterers stand where they seem to be
  std::size_t silenced = 0;  ///< scatterers in a shadow zone
};

/// How many echoes each layer was made of.
struct LayerReport {
  std::string name;
  std::size_t echoes = 0;
};

/// How the sampling was refined (converge_sampling).
struct ConvergenceReport {
  double wanted_db = 0;            ///< 0: it was not
  int samplings = 0;               ///< that were made
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

/// A ping and everything worth knowing about how it came about.
struct SimulatedPing {
  Ping ping;
  Scatterers scatterers;
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
  double noise_floor_db = 0;        ///< used by the detection [dB re 1 uPa]
  StageSeconds seconds;
  std::vector<std::string> notes{};  ///< what to know about this ping, one sentence each with a remedy
};

/// One ping: the whole signal path. Start reading here. What the environment does not hold and the options do not ask
/// for is not computed.
SimulatedPing simulate_ping(const PreparedScene& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {});

/// The same of a scene that is prepared for this one ping: the same bytes. For many pings of a scene, prepare it once.
SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {});

}  // namespace insonify
