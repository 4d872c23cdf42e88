// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "acoustics/echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "returns/contributors.hpp"
#include "returns/detect_soundings.hpp"
#include "sampling/find_scatterers.hpp"

namespace insonify {

/// The choice whether an effect is computed. as_needed: only if the plan of the ping finds that accuracy_db needs it.
enum class Choice { as_needed, always, never };
/// Returns the choice that is made.
constexpr Choice chosen(bool in) { return in ? Choice::always : Choice::never; }

/// Default of SamplingSettings::detail_width if detail is requested without a number.
inline constexpr double usual_detail_width = 1;
/// Default of EffectSettings::double_echoes if they are requested without a number.
inline constexpr double usual_double_echoes = 2;
/// Value of OutputSettings::display_bins if display cells are requested without a number.
inline constexpr int usual_display_bins = 600;

/// Selection of the scatterers that represent the scene.
struct SamplingSettings {
  SamplingKind kind = SamplingKind::surfels;
  /// Surfels are split until a resolution cell holds this number of scatterers; 0: they are never split.
  double scatterers_per_cell = SamplingOptions{}.scatterers_per_cell;
  int rays_per_beam = 64;  ///< for sampling by rays, and for the mask of holes
  bool occlusion = true;
  /// Surfels are merged to nodes of up to this width, in beam widths, within 0 and 4 (E137); 0: as `detail` says.
  /// Surfels with facets are never merged, and no surfels are if an output lists each surfel: scatterers, mask.
  double detail_width = 0;
  /// Instead of detail_width: surfels are merged to nodes of up to this width [m] at any range, so that pings of one
  /// place from different poses have the same scatterers, as repeated passes and synthetic apertures need; 0: none.
  double detail_spacing = 0;
  /// Choice whether surfels are merged. as_needed: if one of the two numbers above is set, and where it pays for
  /// display cells of many pings (PingSimulator::for_many). always: to usual_detail_width if neither is set. never:
  /// whatever is.
  Choice detail = Choice::as_needed;
  double elevation_floor_db = -40;              ///< elevations where the two-way pattern is lower are not sampled; < 0
  double azimuth_margin = 0;                    ///< sampled beyond the outermost beams, in u; 0: 1.5 beam widths
  Choice outer_elevations = Choice::as_needed;  ///< always: elevations below the floor are also sampled
  Choice outer_azimuths = Choice::as_needed;    ///< always: all azimuths are sampled for side lobes, for any margin
};

/// Settings for forming beams from echoes.
struct SynthesisSettings {
  /// `incoherent` gives the expected level without speckle (E65): all amplitudes are of mean power, and layers and
  /// noise add up by their squares. There are no pressures at the elements then.
  SynthesisMethod method = SynthesisMethod::gridded;
  /// Relative L2 error of the image, within 0 and 1; gridded: from 1e-13; element_exact and element outputs: 1e-12 to
  /// 0.1; true_delays: 1e-5 to 0.1.
  double tolerance = 1e-4;
  /// Choice whether method true_delays replaces gridded. as_needed: it does if the error of the narrow-band image
  /// exceeds its share of the budget, except for a planar array, whose rows would be summed one by one. If the
  /// tolerance is finer than the least of true_delays, element_exact replaces gridded, which is slow.
  Choice true_delays = Choice::as_needed;
  /// True if display cells are means of samples even where their statistics are drawn as well without them (E180).
  bool phases = false;
};

/// Effects in addition to direct echoes along straight rays from a head at rest. The plan never adds noise: the user
/// decides on it.
struct EffectSettings {
  Choice multipath = Choice::as_needed;  ///< echoes by way of the environment's surface and bottom (E48)
  /// Ghosts and glints by the environment's mirrors and tank, and by smooth materials (E48, E151, E152).
  Choice mirrors = Choice::as_needed;
  bool noise = false;  ///< thermal, wind and self noise of independent elements (E18, E25, E41)
  /// Absorption over the pulse's band. 0: that of the centre frequency for the whole pulse; 1: also its slope; 2: also
  /// its curvature; empty: 0 or 2, as needed.
  std::optional<int> absorption_order{};
  Choice refraction = Choice::as_needed;  ///< bends rays by the environment's profile (E43)
  Choice moving = Choice::as_needed;      ///< includes the motion of the head (E44)
  /// Double echoes, by way of two surfaces (E158): the number of rays from each resolution cell of the surface, within
  /// 0 and 10 000; 0: no double echoes.
  double double_echoes = 0;
};

/// Takes the contributors of a ping in bands of beams.
class ContributorSink {
 public:
  virtual ~ContributorSink() = default;
  /// `band` holds the contributors of rows of beams, the first of which is `first_beam`.
  virtual void take(const Contributors& band, std::size_t first_beam) = 0;
};

/// Outputs in addition to ping and soundings.
struct OutputSettings {
  bool elements = false;    ///< pressure at every element of a line array, before beams (E61), without noise
  bool layers = false;      ///< each kind of echo as a layer of its own
  bool scatterers = false;  ///< all patches of surface
  bool mask = false;        ///< cells where the scan has holes
  int paths = 0;            ///< number of paths of sound of each kind
  /// Numbers of range bins and of pulses over which the intensity for a display is averaged (E71), beside the
  /// single-look pressure. Bins are independent looks only if they are longer than the pulse. Speckle, noise and relief
  /// of the pulses are independent, as for a head that moves by half its aperture from pulse to pulse. (A head at rest
  /// before a rigid scene has one look, however many pulses it sends.)
  int looks_range = 1, looks_pings = 1;
  /// Number of display cells along range, of which each holds the mean intensity over its area. The ping then has these
  /// cells in place of samples of pressure (Ping::display_cells), and its soundings are of cells; 0: samples.
  int display_bins = 0;
  bool split_phase = false;  ///< Ping::split_phase, for bottom detection: two more images, of a line array's halves
  int contributors = 0;      ///< number of strongest surfels listed for every pixel (E63), at most 255
  /// Takes the contributors in bands of beams, instead of PingOutputs::contributors. A band holds at most
  /// contributor_band_mib [MiB], or two rows. Must outlive the ping; nullptr: none.
  ContributorSink* contributor_sink = nullptr;
  double contributor_band_mib = 512;
  /// True: every display cell gets a label with its share, elevation and second label (Ping::labels, E194), from
  /// expected energies; needs display_bins.
  bool labels = false;
};

/// All options of a ping of a given head, event and environment.
struct SimulationOptions {
  /// Budget for the joint error of all omitted effects [dB], above 0 and at most 20; see plan_ping.
  double accuracy_db = 0.1;
  std::uint64_t seed = 1;
  SurfaceAmplitude amplitude = SurfaceAmplitude::complex_normal;
  SamplingSettings sampling{};
  SynthesisSettings synthesis{};
  EffectSettings effects{};
  OutputSettings outputs{};
  DetectionOptions detection{};  ///< noise floor -inf: all noise in the band, less the array's gain
  int threads = 0;               ///< 0: all cores; the result does not depend on it
};

/// A member of SimulationOptions that is out of its range, or that excludes another one.
struct OptionProblem {
  std::string member;  ///< e.g. "sampling.detail_width"
  std::string value;   ///< e.g. "-1", or "true" of a flag
  std::string rule;    ///< what goes on "must be", e.g. "within 0 and 4"
  const void* at;      ///< address of the member of the options that were judged
};

/// Returns the first problem of the options, for callers that call options by names of their own; none: all are valid.
std::optional<OptionProblem> problem_of(const SimulationOptions& options);

/// Throws Error(argument) for the problem that problem_of returns: "who: options.MEMBER = VALUE, must be RULE".
void require_valid(const SimulationOptions& options, const char* who);

}  // namespace insonify
