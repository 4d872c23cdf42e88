// SPDX-License-Identifier: BSD-3-Clause
// Tests the kinds of echo that make up a ping: they add up to it, and none depends on another.
#include "acoustics/sound_speed_profile.hpp"
#include "returns/compare.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

const std::vector<std::string> all_layers = {"direct", "multipath", "volume", "surface", "bottom", "noise"};

const SmallSonar sonar{
    .beams = 16, .field_of_view_deg = 30, .elevation_width_deg = 40, .max_range = 12, .source_level_db = 200};

/// Returns all sources of sound: a wall 5 m ahead between surface and bottom, water that scatters, wind, self noise.
Environment full_environment() {
  Environment e;
  e.surface = SeaSurface{3, 1e-4, -35};
  e.bottom = FlatBottom{-3};
  e.bottom->lambert_mu = 1e-3;
  e.volume_scattering_db = -60;
  e.wind_speed = 5;
  e.self_noise_db = 40;
  return e;
}

struct Case {
  Environment environment = full_environment();
  SonarHead head = small_head(sonar);
  PingEvent event;
  double lambert_mu = 1e-3;
  SimulationOptions options{.effects = {.multipath = Choice::always, .noise = true}, .outputs = {.layers = true}};

  SimulatedPing ping() const {
    const SceneCloud wall = make_built_in_scene("wall", {.points = 3000, .size = {2, 2}, .lambert_mu = lambert_mu});
    return simulate_event(wall, head, event, environment, options);
  }
};

using Layers = std::map<std::string, ComplexGridF>;

Layers layers_of(const SimulatedPing& p) {
  Layers layers;
  for (const Layer& layer : p.ping.layers) layers[layer.name] = layer.pressure;
  return layers;
}

const SimulatedPing& reference_ping() {
  static const SimulatedPing ping = Case{}.ping();
  return ping;
}

const Layers& reference() {
  static const Layers layers = layers_of(reference_ping());
  return layers;
}

bool same(const ComplexGridF& a, const ComplexGridF& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a == b).all();
}

/// Expects every layer of `changed` to be the reference's times its factor, by default 1 to the last bit.
void expect_scaled(const Case& changed, const std::map<std::string, double>& factors, const char* what) {
  const Layers layers = layers_of(changed.ping());
  ASSERT_EQ(layers.size(), all_layers.size()) << what;
  for (const std::string& name : all_layers) {
    const ComplexGridF& before = reference().at(name);
    ASSERT_GT(before.abs().maxCoeff(), 0) << name;
    const auto factor = factors.find(name);
    if (factor == factors.end()) {
      EXPECT_TRUE(same(layers.at(name), before)) << name << " depends on " << what;
      continue;
    }
    const ComplexGrid wanted = before.cast<std::complex<double>>() * factor->second;
    EXPECT_LT(compare_images(layers.at(name).cast<std::complex<double>>(), wanted).relative_l2, 1e-6)
        << name << " is not linear in " << what;
  }
}

}  // namespace

TEST(Layers, stand_in_the_order_in_which_they_are_added) {
  const SimulatedPing& p = reference_ping();
  ASSERT_EQ(p.ping.layers.size(), all_layers.size());
  for (std::size_t i = 0; i < all_layers.size(); ++i) {
    EXPECT_EQ(p.ping.layers[i].name, all_layers[i]);
    EXPECT_EQ(p.report.layers[i].name, all_layers[i]);
  }
}

// Each layer and the sum are rounded to single precision once: half a unit of 2^-24 of each.
TEST(Layers, add_up_to_the_pressure) {
  const SimulatedPing& p = reference_ping();
  ComplexGrid sum = ComplexGrid::Zero(p.ping.pressure.rows(), p.ping.pressure.cols());
  Grid<double> rounding = p.ping.pressure.cast<std::complex<double>>().abs();
  for (const Layer& layer : p.ping.layers) {
    sum += layer.pressure.cast<std::complex<double>>();
    rounding += layer.pressure.cast<std::complex<double>>().abs();
  }
  const Grid<double> off = (sum - p.ping.pressure.cast<std::complex<double>>()).abs();
  EXPECT_TRUE((off <= std::ldexp(1.0, -24) * rounding * 1.0001 + 1e-44).all());
}

TEST(Layers, are_kept_only_on_request_and_change_nothing) {
  Case c;
  c.options.outputs.layers = false;
  const SimulatedPing without = c.ping();
  EXPECT_TRUE(without.ping.layers.empty());
  EXPECT_EQ(without.report.layers.size(), all_layers.size());
  EXPECT_TRUE(same(without.ping.pressure, reference_ping().ping.pressure));
}

// One after another is taken away: the others stay as they are, to the last bit.
TEST(Layers, are_what_each_is_without_the_others) {
  const std::map<std::string, std::function<void(Case&)>> removals = {
      {"multipath", [](Case& c) { c.options.effects.multipath = Choice::never; }},
      {"volume", [](Case& c) { c.environment.volume_scattering_db.reset(); }},
      {"surface", [](Case& c) { c.environment.surface->scattering_strength_db.reset(); }},
      {"bottom", [](Case& c) { c.environment.bottom->lambert_mu.reset(); }},
      {"noise", [](Case& c) { c.options.effects.noise = false; }}};
  for (const auto& [gone, remove] : removals) {
    Case c;
    remove(c);
    const Layers layers = layers_of(c.ping());
    ASSERT_EQ(layers.size(), all_layers.size() - 1) << gone;
    for (const auto& [name, pressure] : layers)
      EXPECT_TRUE(same(pressure, reference().at(name))) << name << " " << gone;
  }
  Case direct_alone;
  direct_alone.environment = {};
  direct_alone.environment.water.depth = full_environment().surface->height;
  direct_alone.options.effects.multipath = Choice::never;
  direct_alone.options.effects.noise = false;
  EXPECT_TRUE(same(layers_of(direct_alone.ping()).at("direct"), reference().at("direct")));
}

TEST(Layers, are_linear_each_in_its_own_strength) {
  Case louder;
  louder.head.pulse.source_level_db += 20;
  expect_scaled(louder, {{"direct", 10}, {"multipath", 10}, {"volume", 10}, {"surface", 10}, {"bottom", 10}},
                "the source level");
  Case brighter;
  brighter.lambert_mu *= 4;
  expect_scaled(brighter, {{"direct", 2}, {"multipath", 2}}, "the scene's reflectivity");
  Case murky;
  *murky.environment.volume_scattering_db += 10;
  expect_scaled(murky, {{"volume", std::sqrt(10)}}, "volume scattering");
  Case rough;
  *rough.environment.surface->scattering_strength_db += 6;
  expect_scaled(rough, {{"surface", amplitude_from_db(6)}}, "surface scattering");
  Case coarse;
  *coarse.environment.bottom->lambert_mu *= 9;
  expect_scaled(coarse, {{"bottom", 3}}, "the bottom's mu");
  Case noisy;
  *noisy.environment.self_noise_db += 30;
  const double change = element_noise_level_db(noisy.environment, noisy.head.pulse) -
                        element_noise_level_db(Case{}.environment, noisy.head.pulse);
  EXPECT_GT(change, 20);
  expect_scaled(noisy, {{"noise", amplitude_from_db(change)}}, "self noise");
}

// Two scenes pinged together are the sum of both pinged alone, where neither hides the other: ids keep speckle apart.
TEST(Layers, of_two_scenes_are_the_sum_of_both) {
  SceneCloud both, first, second;
  for (int i = 0; i < 40; ++i)
    for (SceneCloud* scene : {&both, &first}) add_surfel(*scene, {5, -1 + 0.02 * i, 0.01 * i}, {-1, 0, 0}, 1e-3);
  for (int i = 0; i < 40; ++i)
    for (SceneCloud* scene : {&both, &second}) add_surfel(*scene, {7, 0.4 + 0.02 * i, 0.01 * i}, {-1, 0, 0}, 1e-3);
  for (std::size_t i = 0; i < second.size(); ++i) second.id[i] = both.id[40 + i];
  const auto image = [](const SceneCloud& scene) -> ComplexGrid {
    return simulate_ping(scene, small_head(sonar), Pose::Identity(), {}).ping.pressure.cast<std::complex<double>>();
  };
  EXPECT_LT(compare_images(image(first) + image(second), image(both)).relative_l2, 1e-4);  // the tolerance
}

// A scene at rest: its echoes, by whatever way, and the bottom's are those of the first ping; what moves by itself is
// not. Correlation of the latter over some 16 beams x 900 bins: about 0.02.
TEST(Layers, of_scene_and_bottom_are_the_same_in_every_ping_and_those_of_water_waves_and_noise_are_not) {
  Case later;
  later.event.number = 17;
  later.event.time = 3.4;
  const Layers layers = layers_of(later.ping());
  for (const char* name : {"direct", "multipath", "bottom"})
    EXPECT_TRUE(same(layers.at(name), reference().at(name))) << name;
  for (const char* name : {"volume", "surface", "noise"}) {
    const ImageDifference d =
        compare_images(layers.at(name).cast<std::complex<double>>(), reference().at(name).cast<std::complex<double>>());
    EXPECT_LT(d.correlation, 0.25) << name;
    EXPECT_NEAR(d.mean_level_db, 0, 1.5) << name;
  }
  Case again;
  EXPECT_TRUE(same(again.ping().ping.pressure, reference_ping().ping.pressure));
}

TEST(Layers, do_not_depend_on_the_thread_count) {
  for (const int threads : {1, 2, 7}) {
    Case c;
    c.options.threads = threads;
    for (const auto& [name, pressure] : layers_of(c.ping())) EXPECT_TRUE(same(pressure, reference().at(name))) << name;
  }
}

TEST(SimulatePing, of_a_head_with_no_velocity_is_that_of_a_head_at_rest_bit_for_bit) {
  Case still;
  still.event.motion = {{0, -0.0, 0}, {-0.0, 0, 0}};
  EXPECT_TRUE(same(still.ping().ping.pressure, reference_ping().ping.pressure));
  Case moving;
  moving.event.motion.velocity = {1, 0, 0};
  const Layers layers = layers_of(moving.ping());
  EXPECT_FALSE(same(layers.at("direct"), reference().at("direct")));
  for (const char* name : {"multipath", "volume", "surface", "bottom", "noise"})  // received as at rest
    EXPECT_TRUE(same(layers.at(name), reference().at(name))) << name;
}

TEST(SimulatePing, in_a_profile_of_one_sound_speed_is_that_without_a_profile_bit_for_bit) {
  Case layered;
  const double c = reference_ping().ping.sound_speed;
  layered.environment.profile = SoundSpeedProfile{{0, 1.5, 10, 4000}, {c, c, c, c}};
  const SimulatedPing p = layered.ping();
  EXPECT_FALSE(p.report.refraction.bent);
  EXPECT_EQ(p.report.refraction.bound.range, 0);
  EXPECT_TRUE(same(p.ping.pressure, reference_ping().ping.pressure));
}

// The series of all elements, beamformed by true delays, is the ping without its noise.
TEST(Elements, of_a_ping_beamform_to_the_ping_itself) {
  Case plain;
  plain.head =
      small_head({.beams = 8, .field_of_view_deg = 30, .elevation_width_deg = 40, .min_range = 4, .max_range = 6});
  plain.options.effects.noise = false;
  plain.options.synthesis.method = SynthesisMethod::element_exact;
  plain.options.outputs.elements = true;
  const SimulatedPing p = plain.ping();
  const ComplexGrid beams = beam_from_elements(p.outputs.elements, plain.head, p.report.medium,
                                               {plain.options.synthesis.tolerance, Wavefront::spherical, 0});
  EXPECT_LT(compare_images(beams, p.ping.pressure.cast<std::complex<double>>()).relative_l2, 1e-6);
  EXPECT_EQ(reference_ping().outputs.elements.pressure.size(), 0);
}
