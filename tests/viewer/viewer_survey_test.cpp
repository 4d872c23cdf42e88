// SPDX-License-Identifier: BSD-3-Clause
// A survey in the viewer: pings read one at a time, sweeps, waterfalls, seeking; and the program on a survey's folder.
#include <set>

#include "core/units.hpp"
#include "returns/sounding_columns.hpp"
#include "scene/built_in_scenes.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/survey_fixture.hpp"
#include "view/test_pictures.hpp"
#include "viewer/three_targets.hpp"
#include "viewer/viewer_explain.hpp"
#include "viewer/viewer_records_internal.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace {

constexpr std::size_t pings_per_sweep = 12;

// Returns ping i of a head of one beam. Its level at bin b grows by a decibel for each ping, and by 20 at bin i.
Ping one_beam_ping(std::size_t i, bool scans) {
  Ping ping;
  ping.number = static_cast<std::int64_t>(i);
  ping.time = 0.5 * static_cast<double>(i);
  ping.world_from_head = pose_from_yaw_pitch_roll({0.1 * static_cast<double>(i), 0, -3}, 0, 0, 0);
  if (scans)
    ping.scan = ScanDirection{static_cast<std::int64_t>(i / pings_per_sweep),
                              radians(30.0 * static_cast<double>(i % pings_per_sweep))};
  ping.fan = make_fan(1, 0, radians(2), radians(20));
  ping.gate = {1, 9, 0.1};
  ping.pressure = ComplexGridF::Constant(1, 80, std::pow(10.0F, static_cast<float>(i) / 20));
  ping.pressure(0, static_cast<Eigen::Index>(i % 80)) *= 10;
  return ping;
}

// A reel that counts its reads, and the pings held at once.
struct CountedReel {
  std::shared_ptr<int> read = std::make_shared<int>(0), beams_read = std::make_shared<int>(0);

  LazyPings reel(std::size_t count, bool scans) const {
    std::vector<TrackPoint> positions;
    for (std::size_t i = 0; i < count; ++i) {
      const Ping ping = one_beam_ping(i, scans);
      positions.push_back({ping.number, ping.time, ping.world_from_head, ping.scan});
    }
    PingSource source;
    source.ping = [scans, read = read](std::size_t i) { return ++*read, one_beam_ping(i, scans); };
    source.beam = [scans, rows_read = beams_read](std::size_t first, std::size_t n, std::size_t beam) {
      *rows_read += static_cast<int>(n);
      ComplexGridF rows(static_cast<Eigen::Index>(n), 80);
      for (std::size_t i = 0; i < n; ++i)
        rows.row(static_cast<Eigen::Index>(i)) =
            one_beam_ping(first + i, scans).pressure.row(static_cast<Eigen::Index>(beam));
      return rows;
    };
    return {std::move(positions), std::move(source)};
  }
};

// Returns a return at a place of its own, of ping i.
Soundings one_return(std::size_t i) {
  Soundings one;
  one.position = {{0.5 * static_cast<double>(i), 0, 0.1}};
  one.level_db = {120}, one.range = {3}, one.azimuth = {0}, one.elevation = {0};
  one.ping = {static_cast<std::uint32_t>(i)}, one.beam = {0}, one.bin = {0};
  one.true_elevation = {0}, one.true_surfel = {Soundings::none}, one.true_material = {Soundings::none};
  return one;
}

class SurveyWindow : public testing::Test {
 protected:
  void open(std::size_t pings, bool scans) {
    data_.title = "survey";
    data_.pings = counted_.reel(pings, scans);
    ViewerOptions options;
    options.width = 800, options.height = 600;
    options.say = [this](const std::string& text) { said_.push_back(text); };
    window_ = std::make_unique<ViewerWindow>(data_, options, ViewerScreen::off_screen);
    window_->run({});
  }
  void click(Point2 at) { window_->click(at); }

  CountedReel counted_;
  ViewerData data_;
  std::unique_ptr<ViewerWindow> window_;
  std::vector<std::string> said_;
};

}  // namespace

TEST(LazyPings, reads_what_is_asked_for_and_keeps_the_last) {
  const CountedReel counted;
  const LazyPings reel = counted.reel(1000, false);
  EXPECT_EQ(*counted.read, 0);
  EXPECT_EQ(reel.gate().bins(), 80U);
  EXPECT_EQ(*counted.read, 1);
  const std::weak_ptr<const Ping> first = reel.ping(7);
  EXPECT_EQ(reel.ping(7)->number, 7);
  EXPECT_EQ(*counted.read, 2);
  EXPECT_EQ(reel.ping(8)->number, 8);
  EXPECT_TRUE(first.expired());  // one is held, however many were read
  EXPECT_THAT(error_of([&] { reel.ping(1000); }, ErrorKind::argument), HasSubstr("must be below 1000"));
}

TEST(LazyPings, refuses_a_ping_of_another_extent) {
  std::vector<Ping> pings{one_beam_ping(0, false), one_beam_ping(1, false)};
  pings[1].gate.max_range = 8;
  pings[1].pressure.conservativeResize(1, 70);
  const LazyPings reel = reel_in_memory(pings);
  EXPECT_EQ(reel.fan().beams(), 1U);
  EXPECT_THAT(error_of([&] { reel.ping(1); }, ErrorKind::content), HasSubstr("ping 1 has 1 x 70 samples"));
}

TEST(ViewerRecords, a_page_holds_the_ping_and_at_most_600) {
  const LazyPings reel = CountedReel().reel(1301, false);
  for (const std::size_t ping : {0, 599, 600, 1199, 1200, 1300}) {
    const PageOfPings page = page_of(reel, ping);
    EXPECT_TRUE(page.first <= ping && ping < page.first + page.count) << ping;
    EXPECT_LE(page.count, 600U);
    EXPECT_GE(page.count, 2U);  // a waterfall of one row would be refused
  }
  EXPECT_EQ(page_of(reel, 599).first, page_of(reel, 0).first);  // the picture stays while the ping goes on
}

// After ping 14 of sweeps of twelve, bearings 0 to 2 are new, and the others those of the sweep before.
TEST(ViewerRecords, a_sweep_shows_every_bearing_as_it_was_heard_last) {
  ViewerData data;
  data.pings = CountedReel().reel(40, true);
  BeamPage page;
  const SweepImage sweep = sweep_at(data, 14, false, page);
  ASSERT_EQ(sweep.ping.size(), pings_per_sweep);
  for (std::size_t beam = 0; beam < pings_per_sweep; ++beam) {
    const std::size_t beam_azimuth = beam <= 2 ? 12 + beam : beam;
    EXPECT_EQ(sweep.ping[beam], beam_azimuth);
    EXPECT_NEAR(sweep.image.level_db(static_cast<Eigen::Index>(beam), 70),
                120 - 20 * std::log10(std::sqrt(2)) + static_cast<double>(beam_azimuth), 1e-3);
    EXPECT_NEAR(std::remainder(sweep.image.fan.azimuth[beam] - radians(30.0 * static_cast<double>(beam)), 2 * pi), 0,
                1e-12);
  }
  // In the first sweep nothing was received from the bearings to come.
  const SweepImage first = sweep_at(data, 3, false, page);
  EXPECT_EQ(first.image.level_db(4, 70), static_cast<float>(silence_db));
  EXPECT_GT(first.image.level_db(3, 70), 100);
  // The last sweep, of four pings, keeps the whole circle.
  EXPECT_EQ(sweep_at(data, 39, false, page).ping.size(), pings_per_sweep);
}

TEST_F(SurveyWindow, playing_reads_every_ping_once) {
  open(300, false);
  const int before = *counted_.read;
  EXPECT_LE(before, 20);  // the colour scale looks at 16 of them
  for (int i = 0; i < 8; ++i) window_->press_key("Right");
  EXPECT_EQ(window_->state().ping, 8U);
  EXPECT_LE(*counted_.read, before + 8);
  EXPECT_LE(*counted_.beams_read, 300);  // the waterfall is read once
}

TEST_F(SurveyWindow, a_click_on_the_waterfall_goes_to_the_ping) {
  open(200, false);
  EXPECT_EQ(window_->layout().history.width(), 0);  // the waterfall is the first panel
  const Box& box = window_->layout().fan;
  click({box.left + 0.5 * box.width(), box.bottom + 0.75 * box.height()});
  const std::size_t high = window_->state().ping;
  ASSERT_TRUE(window_->state().selected);
  EXPECT_GT(high, 110U);  // newest on top
  EXPECT_LT(high, 190U);
  click({box.left + 0.3 * box.width(), box.bottom + 0.4 * box.height()});
  EXPECT_LT(window_->state().ping, high - 40);
  EXPECT_THAT(said_.back(), HasSubstr("Ping " + std::to_string(window_->state().ping)));
}

TEST_F(SurveyWindow, a_click_on_a_sweep_goes_to_the_ping_that_heard_it) {
  open(40, true);
  window_->press_key("Next");
  window_->press_key("Next");
  window_->press_key("Next");
  window_->press_key("Next");
  EXPECT_EQ(window_->state().ping, 16U);
  // Straight to starboard of the head is bearing 90 degrees, scan angle 270: ping 9 of the sweep before.
  const Box& box = window_->layout().fan;
  click({box.left + 0.6 * box.width(), box.bottom + 0.47 * box.height()});
  EXPECT_EQ(window_->state().ping, 9U);
  EXPECT_THAT(said_.back(), HasSubstr("Turn of the head"));
}

TEST_F(SurveyWindow, the_timeline_seeks_and_stops_playing) {
  open(201, false);
  window_->press_key("space");
  EXPECT_TRUE(window_->state().playing);
  const Box& box = window_->layout().timeline;
  ViewerEvent event = parse_viewer_script("click timeline 0 0").front();
  event.from = {0.75 * box.width(), 0.5 * box.height()};
  window_->play(event);
  EXPECT_NEAR(static_cast<double>(window_->state().ping), 152, 6);
  EXPECT_FALSE(window_->state().playing);
  window_->press_key("Next");
  EXPECT_NEAR(static_cast<double>(window_->state().ping), 172, 6);
}

// The status line and the keys stay, so that pictures differ by the returns alone.
TEST_F(SurveyWindow, a_gathers_returns_of_earlier_pings) {
  data_.scene = make_built_in_scene("plane", {.points = 400, .size = {20, 20}});
  for (std::size_t i = 0; i < 20; ++i) append_row(data_.returns, one_return(i), 0);
  open(20, false);
  window_->press_key("End");
  const std::string alone = own_path("alone.png"), gathered = own_path("gathered.png"), again = own_path("again.png");
  window_->save_png(alone);
  window_->press_key("a");
  window_->save_png(gathered);
  EXPECT_NE(read_png(alone).bytes, read_png(gathered).bytes);
  window_->press_key("a");
  window_->save_png(again);
  EXPECT_EQ(read_png(alone).bytes, read_png(again).bytes);
}

// The returns of another head are gathered up to the time of the ping, though this head has none.
TEST_F(SurveyWindow, a_gathers_returns_of_other_heads) {
  data_.scene = make_built_in_scene("plane", {.points = 400, .size = {20, 20}});
  std::vector<TrackPoint> positions;
  for (std::size_t i = 0; i < 40; ++i) positions.push_back(one_beam_ping(i, false));
  std::size_t last = 0;
  PingSource source;
  source.returns = [&last](std::size_t i) {
    last = std::max(last, i);
    return one_return(i);
  };
  data_.others.emplace_back(positions, source);
  open(20, false);
  window_->press_key("End");
  const std::string alone = own_path("head.png"), gathered = own_path("heads.png");
  window_->save_png(alone);
  window_->press_key("a");
  window_->save_png(gathered);
  EXPECT_NE(read_png(alone).bytes, read_png(gathered).bytes);
  EXPECT_EQ(last, 19U) << "pings at the time of ping 19 and before";
}

// Port is to the left of starboard; a place as far on the other side is the same range.
TEST_F(SurveyWindow, sides_of_a_side_scan_are_one_waterfall) {
  std::vector<Ping> pings;
  for (std::size_t i = 0; i < 100; ++i) {
    Ping ping = one_beam_ping(i, false);
    const ComplexGridF port = ping.pressure;
    ping.fan.azimuth = {pi / 2, -pi / 2}, ping.fan.elevation = {0, 0};
    ping.pressure.resize(2, port.cols());
    ping.pressure << port, 10 * port;
    pings.push_back(ping);
  }
  data_.sides = true, data_.title = "sides", data_.pings = reel_in_memory(pings);
  ViewerOptions options;
  options.width = 800, options.height = 600;
  window_ = std::make_unique<ViewerWindow>(data_, options, ViewerScreen::off_screen);
  window_->run({});
  EXPECT_EQ(picture_of(data_), ViewerPicture::sides);
  EXPECT_EQ(window_->layout().history.width(), 0);
  const Box& box = window_->layout().fan;
  std::set<std::size_t> beams;
  std::vector<double> middles;
  for (double at = 0.1; at < 0.9; at += 0.01) {
    click({box.left + at * box.width(), box.bottom + 0.6 * box.height()});
    if (!window_->state().selected) continue;
    const auto [beam, bin] = *window_->state().selected;
    beams.insert(beam);
    EXPECT_TRUE(beam == 0 || !middles.empty());
    if (beam == 0) middles.push_back(static_cast<double>(bin));
  }
  EXPECT_EQ(beams, (std::set<std::size_t>{0, 1}));
  ASSERT_GT(middles.size(), 5U);
  EXPECT_TRUE(std::is_sorted(middles.rbegin(), middles.rend())) << "ranges to port grow to the left";
  data_.pings = CountedReel().reel(3, false);
  EXPECT_THAT(error_of([&] { require_viewable(data_, ViewerMode::run); }, ErrorKind::content),
              HasSubstr("1 beams of sides, must be port and starboard"));
}

TEST_F(SurveyWindow, runs_with_a_water_level_have_a_scale_of_depths) {
  data_.scene = make_built_in_scene("plane", {.points = 400, .size = {20, 20}});
  open(20, false);
  const std::string heights = own_path("heights.png"), depths = own_path("depths.png");
  window_->save_png(heights);
  data_.depth_datum = "below MSL";
  open(20, false);
  window_->save_png(depths);
  EXPECT_NE(read_png(heights).bytes, read_png(depths).bytes);
}

TEST_F(SurveyWindow, buttons_press_their_keys) {
  open(200, false);
  const auto press = [&](const char* key) {
    const auto at = window_->pixel_of_button(key);
    ASSERT_TRUE(at) << key;
    click(*at);
  };
  press("Right");
  EXPECT_EQ(window_->state().ping, 1U);
  press("space");
  EXPECT_TRUE(window_->state().playing);
  press("space");
  // Buttons without room are in the help.
  window_->press_key("h");
  press("m");
  EXPECT_NE(window_->state().colour_map, ViewerState{}.colour_map);
  press("q");
  EXPECT_TRUE(window_->finished());
}

namespace {

class ViewSurvey : public SurveyTest {
 protected:
  std::string shown(const std::string& arguments) const {
    return succeed("view " + arguments + " --size 800x600 --force --screenshot a.png -q");
  }
};

}  // namespace

// From its shards and merged, as a whole and by the folder of a head, a survey looks the same.
TEST_F(ViewSurvey, is_played_from_shards_and_merged) {
  survey("run");
  EXPECT_THAT(shown("run --ping 5 --events 'select 3 200'"), HasSubstr("Ping 5, beam 3, bin 200"));
  const std::string from_shards = read("a.png");
  succeed("merge run -q");
  shown("run/fls --ping 5 --events 'select 3 200'");
  EXPECT_EQ(read("a.png"), from_shards);
  EXPECT_THAT(shown("run --head turning --ping 3 --no-scene --events 'select 0 9; key End; select 0 9'"),
              AllOf(HasSubstr("Turn of the head -135.00°"), HasSubstr("Ping 12, ")));
  // The blocks are not needed once they are copied.
  succeed("merge run --copy -q");
  for (const char* head : {"fls", "turning"}) std::filesystem::remove_all(path("run/" + std::string(head) + "/blocks"));
  EXPECT_THAT(shown("run --ping 5 --no-scene --events 'select 3 200'"), HasSubstr("Ping 5, beam 3, bin 200"));
}

TEST_F(ViewSurvey, says_what_is_missing) {
  survey("run", "--shard 1/2");
  const ToolResult result = run("view run --size 800x600 --no-scene --screenshot a.png --events 'select 0 3'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("3 of 5 blocks of fls are not done yet"));
  EXPECT_THAT(result.err, HasSubstr("other heads too: --head turning"));
  EXPECT_THAT(result.out, HasSubstr("Ping 3, "));  // the first of block 1
  expect_refused("view run --head sonar --screenshot b.png", 2,
                 {"--head = 'sonar' is not in run; it has fls, turning"});
  expect_refused("view harbour.ply --head fls --sonar p900-45 --pose=0,0,0,0,0,0 --screenshot b.png", 2, {"--head"});
}

// A ball that moves across is explained where it is at the time of each ping, without labels in the cube.
TEST_F(ViewSurvey, has_moving_parts_where_they_are_at_each_ping) {
  have("ball.ply", "make-object sphere --set diameter_m=0.8");
  write("scene.toml",
        "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n[[part]]\nfile = \"ball.ply\"\nposition_m = [3.5, 1, -3]\n"
        "velocity_mps = [0, -2, 0]\n");
  write("m.toml",
        "schema = 1\n[survey]\nscene = \"scene.toml\"\n[trajectory]\nwaypoints_m = [[0, 0, -3], [0.0025, 0, -3]]\n"
        "speed_m_s = 0.001\n[[head]]\nname = \"fls\"\nsonar = \"p900-45\"\nrange = \"1:6\"\n"
        "set = [\"sonar.beams=33\"]\nrate_hz = 1\n");
  survey("run");
  succeed("merge run -q");
  const Cube cube = read_cube(path("run/fls/cube.h5"));
  ASSERT_GE(cube.pings.size(), 2U);
  for (const std::size_t ping : {0U, 1U})
    for (const std::size_t at : {0U, 1U}) {
      // The face of the ball towards the head.
      const Eigen::Vector3d centre(3.5, 1 - 2.0 * static_cast<double>(at), -3), head(0, 0, -3);
      const auto position = position_of(cube.pings[ping], centre - 0.38 * (centre - head).normalized());
      ASSERT_TRUE(position);
      const std::string said = shown("run --ping " + std::to_string(ping) + " --events 'select " +
                                     std::to_string(position->beam) + " " + std::to_string(position->bin) + "'");
      EXPECT_THAT(said, ping == at ? testing::Matcher<std::string>(HasSubstr("Part ball"))
                                   : testing::Not(HasSubstr("Part ball")))
          << ping << " at " << at;
    }
}

// Both heads of a side-scan are shown, unless one is named. Depths are those below the datum of the mission.
TEST_F(ViewSurvey, shows_both_sides_of_a_side_scan) {
  write("m.toml", R"(schema = 1
[survey]
scene = "harbour.ply"
[water]
level_m = 0
datum = "MSL"
[trajectory]
waypoints_m = [[0, 0, -3], [3, 0, -3]]
speed_m_s = 1
[[head]]
name = "left"
sonar = "starfish-450"
range = "1:8"
rate_hz = 1
[[head]]
name = "right"
sonar = "starfish-450"
side = "starboard"
range = "1:8"
rate_hz = 1
)");
  survey("run");
  EXPECT_THAT(shown("run --ping 1 --events 'select 1 200'"), HasSubstr("Ping 1, beam 1, bin 200"));
  const std::string both = read("a.png");
  EXPECT_THAT(shown("run --head right --ping 1 --events 'select 0 200'"), HasSubstr("Ping 1, beam 0, bin 200"));
  EXPECT_NE(read("a.png"), both);
  expect_refused("view run --head left --beam 1 --screenshot b.png", 2, {"--beam = 1", "below 1"});
  expect_refused("view run --beam 2 --screenshot b.png", 2, {"--beam = 2", "below 2"});
}
