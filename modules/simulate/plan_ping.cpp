#include "simulate/plan_ping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "acoustics/multipath_echoes.hpp"
#include "beamforming/beam_pattern.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "simulate/scene_sample_internal.hpp"
#include "simulate/stage_options_internal.hpp"

namespace insonify {
namespace {

/// Twice in amplitude: for speckle, and for what of the scene hides other parts of it.
constexpr double margin = 2;

/// Adds up the stages of one plan.
class Planner {
 public:
  Planner(const SceneCloud& scene, const SonarHead& head, const Pose& pose, const Environment& environment,
          const SimulationOptions& options)
      : scene_(scene),
        head_(head),
        environment_(environment),
        options_(options),
        medium_(medium_of(environment, head.pulse.centre_frequency, options.absorption_order)),
        sample_(sample_scene(scene, head, pose, medium_, options)),
        view_(view_of(largest_area(scene), head, pose, medium_, options)) {
    SonarHead row = head;
    row.column.reset();
    row.fan.row_width = 0;
    std::fill(row.fan.elevation.begin(), row.fan.elevation.end(), row.fan.elevation[0]);
    plan_.synthesis = PingSynthesizer(row, medium_, {options.tolerance, 1}).choice();
  }

  PingPlan plan() {
    geometry();
    propagation();
    boundaries();
    surfaces();
    synthesis();
    estimate();
    return std::move(plan_);
  }

 private:
  void add(const char* name, bool included, const std::string& why, double bound) {
    if (included) bound = 0;
    plan_.stages.push_back({name, included, why, bound, db_from_amplitude(1 + bound)});
  }

  /// Amplitude of what `power` adds to the image, relative to what is in view.
  double relative(double power) const {
    if (power == 0) return 0;
    return sample_.in_view > 0 ? margin * std::sqrt(power / sample_.in_view) : std::numeric_limits<double>::infinity();
  }

  void geometry() {
    if (scene_.normals_oriented)
      add("back-faces", false,
          std::to_string(sample_.back_facing) + " surfels in view turn away: Lambert's law gives nothing", 0);
    else
      add("back-faces", true, "normals have no side: both sides reflect", 0);
    add("other-ranges", false, "pulses from there have ended before the gate begins, or begin after it",
        relative(sample_.beyond_gate));
    add("outer-elevations", false,
        "the elevation pattern is below " + std::to_string(static_cast<int>(options_.elevation_floor_db)) + " dB there",
        relative(sample_.off_elevation));
    add("outer-azimuths", false, "beams hear only side lobes from there",
        side_lobe() / plan_.synthesis.share * relative(sample_.off_azimuth));
    add("occlusion", options_.occlusion, options_.occlusion ? "surfels hide others" : "left out on request",
        std::numeric_limits<double>::infinity());
  }

  /// Highest response beside the main lobe, of the beam ahead and of the outermost ones.
  double side_lobe() const {
    const double wavelength = medium_.sound_speed / head_.pulse.centre_frequency;
    double highest = 0;
    const auto [low, high] = std::minmax_element(head_.fan.azimuth.begin(), head_.fan.azimuth.end());
    for (const double azimuth : {0.0, *low, *high}) {
      const double steering = std::clamp(azimuth, -pi / 2, pi / 2);
      const BeamPatternReport beam = measure_beam_pattern(head_.array, wavelength, steering);
      if (!beam.grating_lobes.empty() || head_.array.elements() == 1) return 1;
      highest = std::max(highest, amplitude_from_db(beam.highest_side_lobe_db));
    }
    return highest;
  }

  void propagation() {
    const Absorption full =
        absorption_about(environment_.water, head_.pulse.centre_frequency, 2, environment_.absorption_formula);
    const double half_band = 0.5 * head_.pulse.bandwidth, way = 2 * sample_.in_view_farthest;
    add("absorption-slope", options_.absorption_order > 0,
        options_.absorption_order > 0 ? "asked for: each frequency of the pulse has its own absorption"
                                      : "a peak stays SL - 2 TL + TS: one absorption for the whole pulse",
        way * half_band * (std::abs(full.a1) + std::abs(full.a2) * half_band));
    refraction();
    add("motion", !options_.motion.none(), options_.motion.none() ? "the head is at rest" : "the head moves", 0);
  }

  void refraction() {
    if (!environment_.profile) return add("refraction", false, "one sound speed everywhere", 0);
    Scatterers places = sample_.places;
    const RefractionReport report = refract(environment_, view_, options_.refraction, head_.gate.bin_size, places);
    const double turn = 4 * pi * head_.pulse.centre_frequency / medium_.sound_speed * report.bound.range;
    add("refraction", report.bent,
        report.bent ? "straight rays would be off by a bin, or by what the elevation pattern feels"
                    : "straight rays stay within a bin; speckle changes, levels do not",
        std::min(margin, turn));
  }

  void boundaries() {
    const bool boundary = environment_.surface || environment_.bottom;
    const Transmission sent{head_.pulse, medium_, echo_options_of(head_, options_)};
    const double bounce = boundary ? strongest_bounce(environment_, view_, sent) : 0;
    add("multipath", options_.multipath && boundary,
        !boundary            ? "no surface and no bottom"
        : options_.multipath ? "asked for"
                             : "not asked for",
        bounce == 0 ? 0 : (2 * bounce + bounce * bounce) * relative(sample_.anywhere));
    const auto strength = [&](const char* name, bool present) {
      add(name, present, present ? "the environment gives its scattering strength" : "no scattering strength given", 0);
    };
    strength("volume", environment_.volume_scattering_db.has_value());
    strength("surface", environment_.surface && environment_.surface->scattering_strength_db);
    strength("bottom", environment_.bottom && environment_.bottom->lambert_mu);
    add("noise", options_.noise, options_.noise ? "asked for" : "not asked for", noise_bound());
  }

  /// Noise power in the image over that of its echoes, as amplitudes.
  double noise_bound() const {
    const double noise = 2 * power_from_db(element_noise_level_db(environment_, head_.pulse) - array_gain_db(head_)) *
                         micropascal * micropascal * static_cast<double>(head_.gate.bins());
    const double pulse_bins = 0.469719 / head_.pulse.bandwidth * medium_.sound_speed / (2 * head_.gate.bin_size);
    const double share = plan_.synthesis.share;
    return relative(noise / (share * share * pulse_bins));
  }

  void surfaces() {
    const auto any = [&](double Material::*number) {
      return std::any_of(scene_.materials.begin(), scene_.materials.end(),
                         [number](const Material& m) { return m.*number > 0; });
    };
    const bool relief = any(&Material::relief_slope), coherent = any(&Material::coherent_fraction);
    add("micro-relief", relief, relief ? "a material has a relief slope" : "no material has a relief slope", 0);
    add("coherent-part", coherent,
        coherent ? "a material has a coherent fraction" : "no material has a coherent fraction", 0);
  }

  void synthesis() {
    const bool direct = options_.method == SynthesisMethod::direct;
    add("direct-sum", direct, direct ? "asked for" : "gridding keeps the tolerance", options_.tolerance);
    const bool exact = options_.method == SynthesisMethod::element_exact;
    add("true-delays", exact,
        exact ? "asked for" : "one beam pattern at all frequencies and ranges, focused: narrow band, far field",
        true_delay_bound());
    add("double-precision", direct || !plan_.synthesis.single_precision,
        plan_.synthesis.single_precision ? "the tolerance leaves room for single precision" : "the tolerance needs it",
        options_.tolerance);
  }

  /// First-order change of the image by the pulse's different arrival at the elements, 2.668 B / (2 pi f) |du B'|, and by
  /// what focusing leaves of the waves' curvature, |du B''| u / (k r), each as a root mean square over the pattern B.
  double true_delay_bound() const {
    const double k = 2 * pi * head_.pulse.centre_frequency / medium_.sound_speed;
    std::vector<double> u_beam;
    for (std::size_t b = 0; b < head_.fan.beams(); ++b)
      u_beam.push_back(std::cos(head_.fan.elevation[b]) * std::sin(head_.fan.azimuth[b]));
    const auto [low, high] = std::minmax_element(u_beam.begin(), u_beam.end());
    const double span = std::min(2.0, *high - *low + 2 * std::sin(std::min(head_.fan.beam_width, pi / 2)));
    const std::size_t elements = head_.array.elements(), steps = 8 * elements + 64;
    double pattern = 0, first = 0, second = 0;
    for (std::size_t s = 0; s < steps; ++s) {
      const double du = span * (2 * (static_cast<double>(s) + 0.5) / static_cast<double>(steps) - 1);
      double b = 0, b1 = 0, b2 = 0;
      for (std::size_t m = 0; m < elements; ++m) {
        const double y = head_.array.spacing * element_place(m, elements), w = head_.array.shading[m];
        const double cosine = std::cos(k * y * du), sine = std::sin(k * y * du);
        b += w * cosine, b1 -= w * k * y * sine, b2 -= w * k * y * k * y * cosine;
      }
      pattern += b * b, first += du * du * b1 * b1, second += du * du * b2 * b2;
    }
    const double band = 2.668 * head_.pulse.bandwidth / (2 * pi * head_.pulse.centre_frequency);
    const double steepest = std::max(std::abs(*low), std::abs(*high));
    const double curvature = sample_.in_view_nearest > 0 ? steepest / (k * sample_.in_view_nearest) : 0;
    return std::min(2.0, margin * (band * std::sqrt(first / pattern) + curvature * std::sqrt(second / pattern)));
  }

  /// Rough costs: 0.6 us per scatterer for sampling and echo_options, 0.1 us per scatterer and row for gridding, and the
  /// transforms of all bins.
  void estimate() {
    plan_.surfels_in_view = sample_.surfels;
    plan_.scatterers = sample_.scatterers;
    const double rows = static_cast<double>(fan_rows(head_.fan).size()), bins = static_cast<double>(head_.gate.bins());
    const double beams = static_cast<double>(head_.fan.beams());
    plan_.seconds = 2e-8 * static_cast<double>(scene_.size()) + 6e-7 * plan_.scatterers +
                    rows * (1e-7 * plan_.scatterers + 6e-6 * bins);
    plan_.mib = (120 * plan_.scatterers + 40 * beams * bins + 45 * static_cast<double>(scene_.size())) / 0x1p20;
  }

  const SceneCloud& scene_;
  const SonarHead& head_;
  const Environment& environment_;
  const SimulationOptions& options_;
  Medium medium_;
  SceneSample sample_;
  View view_;
  PingPlan plan_;
};

}  // namespace

PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                   const Environment& environment, const SimulationOptions& options) {
  require_valid(scene, "plan_ping");
  require_valid(head, "plan_ping");
  require_valid(environment, "plan_ping");
  return Planner(scene, head, world_from_head, environment, options).plan();
}

void force_stage(const std::string& name, bool included, Environment& environment, SimulationOptions& options) {
  const auto absent = [&](const char* what) {
    fail(ErrorKind::argument, "force_stage: ", name, " cannot be forced in: ", what);
  };
  if (name == "outer-elevations") {
    options.elevation_floor_db = included ? -400 : -40;
  } else if (name == "outer-azimuths") {
    options.azimuth_margin = included ? pi : 0;
  } else if (name == "occlusion") {
    options.occlusion = included;
  } else if (name == "absorption-slope") {
    options.absorption_order = included ? 2 : 0;
  } else if (name == "refraction") {
    if (included && !environment.profile) absent("there is no sound-speed profile");
    options.refraction = included ? Choice::always : Choice::never;
  } else if (name == "motion") {
    if (included && options.motion.none()) absent("the head is at rest");
    if (!included) options.motion = {};
  } else if (name == "multipath") {
    if (included && !environment.surface && !environment.bottom) absent("there is neither surface nor bottom");
    options.multipath = included;
  } else if (name == "noise") {
    options.noise = included;
  } else if (name == "volume") {
    if (included && !environment.volume_scattering_db) absent("volume.scattering_db is not given");
    if (!included) environment.volume_scattering_db.reset();
  } else if (name == "surface") {
    if (included && !(environment.surface && environment.surface->scattering_strength_db))
      absent("surface.scattering_db is not given");
    if (!included && environment.surface) environment.surface->scattering_strength_db.reset();
  } else if (name == "bottom") {
    if (included && !(environment.bottom && environment.bottom->lambert_mu))
      absent("bottom.lambert_mu_db is not given");
    if (!included && environment.bottom) environment.bottom->lambert_mu.reset();
  } else if (name == "true-delays") {
    options.method = included ? SynthesisMethod::element_exact : SynthesisMethod::gridded;
  } else if (name == "direct-sum") {
    options.method = included ? SynthesisMethod::direct : SynthesisMethod::gridded;
  } else {
    fail(ErrorKind::argument, "force_stage: '", name, "' cannot be forced; these can: outer-elevations, ",
         "outer-azimuths, occlusion, absorption-slope, refraction, motion, multipath, noise, volume, surface, bottom, ",
         "direct-sum, true-delays");
  }
}

}  // namespace insonify
