// SPDX-License-Identifier: BSD-3-Clause
// A survey in the window of the viewer: sweeps, waterfalls, seeking, returns that gather.
#include <set>

#include "returns/sounding_columns.hpp"
#include "scene/built_in_scenes.hpp"
#include "view/test_pictures.hpp"
#include "viewer/survey_window.hpp"

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
