#pragma once
#include <cstdint>

#include "acoustics/hear_scatterers.hpp"
#include "beamforming/synthesize.hpp"
#include "returns/detect_soundings.hpp"
#include "returns/ping.hpp"
#include "sampling/find_scatterers.hpp"

namespace insonify {

enum class SynthesisMethod { stamped, direct };

struct SimulationOptions {
  std::uint64_t seed = 1;
  SamplingKind sampling = SamplingKind::surfels;
  double scatterers_per_cell = 10;
  int rays_per_beam = 64;
  bool occlusion = true;
  SurfaceAmplitude amplitude = SurfaceAmplitude::complex_normal;
  SynthesisMethod method = SynthesisMethod::stamped;
  double tolerance = 1e-4;
  bool noise = false;            ///< adds thermal noise of independent elements (E18, E41)
  int absorption_order = 0;      ///< 0: absorption of the centre frequency for the whole pulse
  DetectionOptions detection{};  ///< noise floor -inf: thermal noise in the band, less the array's directivity
  int threads = 0;               ///< 0: all cores; the result does not depend on it
};

/// Wall time of each stage [s].
struct StageSeconds {
  double sampling = 0, acoustics = 0, synthesis = 0, detection = 0;
};

/// A ping and everything worth knowing about how it came about.
struct SimulatedPing {
  Ping ping;
  Scatterers scatterers;
  Soundings soundings;
  SamplingReport sampling;
  Medium medium;
  double noise_floor_db = 0;  ///< used by the detection [dB re 1 uPa]
  StageSeconds seconds;
};

/// One ping: the whole signal path. Start reading here.
SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Water& water, const SimulationOptions& options = {});

}  // namespace insonify
