// SPDX-License-Identifier: BSD-3-Clause
// Compares a ping with one stage of the plan with the ping without it: no stage changes how the surfels of others are
// split, and with that their speckle.
#include <map>

#include "scene/built_in_scenes.hpp"
#include "simulate/plan_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

/// Returns a fan, or a head of one beam, which receives from all sides.
SonarHead head_of(std::size_t beams) {
  return small_head({.beams = beams, .field_of_view_deg = 40, .beam_width_deg = 2, .max_range = 14});
}

const PingEvent at{pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0), {{0.3, 0.1, 0}, {0, 0, 0.02}}};

Environment sea() {
  Environment e;
  e.surface = SeaSurface{.height = 0, .rms_height = 0.001};
  e.profile = SoundSpeedProfile{{0, 5, 30}, {1490, 1489, 1480}};
  return e;
}

const SceneCloud& small_harbour() {
  static const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  return scene;
}

/// Returns options with all stages out that the budget decides.
SimulationOptions bare() {
  SimulationOptions o;
  Environment e = sea();
  for (const char* stage :
       {"outer-elevations", "outer-azimuths", "absorption-slope", "refraction", "motion", "multipath", "true-delays"})
    force_stage(stage, false, at, e, o);
  o.outputs.scatterers = o.outputs.layers = true;
  return o;
}

SimulatedPing ping(std::size_t beams, const std::string& with) {
  SimulationOptions o = bare();
  Environment e = sea();
  if (!with.empty()) force_stage(with, true, at, e, o);
  return simulate_event(small_harbour(), head_of(beams), at, e, o);
}

std::map<std::uint64_t, float> areas_of(const Scatterers& s) {
  std::map<std::uint64_t, float> areas;
  for (std::size_t i = 0; i < s.size(); ++i) areas[s.id[i]] = s.projected_area[i];
  return areas;
}

}  // namespace

TEST(LikeWithLike, no_stage_splits_what_is_in_view_in_another_way) {
  for (const std::size_t beams : {24U, 1U}) {
    const auto alone = areas_of(ping(beams, "").outputs.scatterers);
    ASSERT_GT(alone.size(), 10000U);
    for (const char* stage : {"outer-elevations", "outer-azimuths", "absorption-slope", "refraction", "motion",
                              "multipath", "true-delays"}) {
      const SimulatedPing more = ping(beams, stage);
      ASSERT_EQ(more.report.refraction.paths.silenced, 0U);
      const auto with = areas_of(more.outputs.scatterers);
      std::size_t others = 0;
      for (const auto& [id, area] : alone) {
        const auto same = with.find(id);
        // Refracted rays change what comes back from a patch, not its position in the list.
        others += same == with.end() || (std::string(stage) != "refraction" && same->second != area);
      }
      EXPECT_EQ(others, 0U) << stage << ", " << beams << " beams, of " << alone.size();
      const bool wider = std::string(stage).starts_with("outer");
      if (!wider) {
        EXPECT_EQ(with.size(), alone.size()) << stage << ", " << beams << " beams";
      }
    }
  }
}

// So what multipath adds is its own layer and nothing else.
TEST(LikeWithLike, direct_echoes_are_the_same_with_and_without_multipath) {
  for (const std::size_t beams : {24U, 1U}) {
    const SimulatedPing without = ping(beams, ""), with = ping(beams, "multipath");
    ASSERT_EQ(with.ping.layers.size(), 2U);
    EXPECT_EQ(with.ping.layers[0].name, "direct");
    EXPECT_TRUE((with.ping.layers[0].pressure == without.ping.pressure).all()) << beams;
    EXPECT_GT(with.ping.layers[1].pressure.abs().maxCoeff(), 0);
  }
}

// Bounced echoes are split as in main lobes everywhere, since main lobes may receive them.
TEST(LikeWithLike, multipath_has_as_many_scatterers_as_main_lobes_ask_for) {
  const auto echoes = [](double per_cell) {
    SimulationOptions o = bare();
    Environment e = sea();
    o.sampling.scatterers_per_cell = per_cell;
    o.sampling.outer_azimuths = Choice::always;
    force_stage("multipath", true, at, e, o);
    return simulate_event(small_harbour(), head_of(1), at, e, o).report.layers;
  };
  const auto layers = echoes(8);
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_GT(layers[1].echoes, 3 * layers[0].echoes);
}
