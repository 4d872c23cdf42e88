// SPDX-License-Identifier: BSD-3-Clause
// Keys and clicks as functions from state to state.
#include "viewer/viewer_state.hpp"

#include "support/test.hpp"
#include "view/picture.hpp"

namespace {

constexpr ViewerExtent extent{5, 64, 200};

ViewerState after(ViewerState state, std::initializer_list<const char*> keys) {
  for (const char* key : keys) state = apply_key(state, key, extent).state;
  return state;
}

ViewerState inspecting() {
  ViewerState state;
  state.mode = ViewerMode::inspect;
  state.head.position = {1, 2, -3};
  return state;
}

}  // namespace

TEST(ViewerKeys, step_through_the_pings_and_stop_at_both_ends) {
  EXPECT_EQ(after({}, {"Right", "period"}).ping, 2U);
  EXPECT_EQ(after({}, {"Right", "Right", "Left"}).ping, 1U);
  EXPECT_EQ(after({}, {"Left", "comma"}).ping, 0U);
  EXPECT_EQ(after({}, {"End"}).ping, 4U);
  EXPECT_EQ(after({}, {"End", "Right"}).ping, 4U);
  EXPECT_EQ(after({}, {"End", "Home"}).ping, 0U);
}

TEST(ViewerKeys, a_gathers_the_returns_of_all_pings_so_far) {
  EXPECT_TRUE(after({}, {"a"}).accumulate);
  EXPECT_FALSE(after({}, {"a", "a"}).accumulate);
}

TEST(ViewerKeys, gain_and_window_move_by_decibels_within_limits) {
  EXPECT_EQ(after({}, {"Up", "Up", "Down"}).gain_db, 2);
  EXPECT_EQ(after({}, {"bracketright"}).window_db, 50);
  EXPECT_EQ(after({}, {"bracketleft", "bracketleft"}).window_db, 35);
  ViewerState state;
  for (int i = 0; i < 1000; ++i) state = after(state, {"Down", "bracketleft"});
  EXPECT_EQ(state.window_db, 5);
  EXPECT_EQ(state.gain_db, -200);
}

TEST(ViewerKeys, colour_maps_come_round_after_all_of_them) {
  ViewerState state;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < colour_map_names().size(); ++i) {
    seen.insert(state.colour_map);
    state = after(state, {"m"});
  }
  EXPECT_EQ(seen.size(), colour_map_names().size());
  EXPECT_EQ(state.colour_map, ViewerState{}.colour_map);
}

TEST(ViewerKeys, a_switch_pressed_twice_is_as_before) {
  for (const char* key : {"t", "h", "u", "g", "d", "space"}) {
    const ViewerState once = after({}, {key}), twice = after(once, {key}), none;
    const auto facts = [](const ViewerState& s) {
      return std::vector<bool>{s.tvg, s.show_help, s.show_colour_bars, s.show_grid, s.measure.active, s.playing};
    };
    EXPECT_NE(facts(once), facts(none)) << key;
    EXPECT_EQ(facts(twice), facts(none)) << key;
  }
}

TEST(ViewerKeys, ask_for_what_is_not_a_state) {
  const auto requested = [](const char* key) { return apply_key({}, key, extent).request; };
  EXPECT_EQ(requested("q"), ViewerRequest::quit);
  EXPECT_EQ(requested("e"), ViewerRequest::quit);
  EXPECT_EQ(requested("j"), ViewerRequest::screenshot);
  EXPECT_EQ(requested("r"), ViewerRequest::reset_cameras);
  EXPECT_EQ(requested("p"), ViewerRequest::none);
  EXPECT_EQ(apply_key(inspecting(), "p", {}).request, ViewerRequest::print_pose);
  EXPECT_EQ(requested("Right"), ViewerRequest::none);
}

TEST(ViewerKeys, shift_and_arrows_move_the_selection_from_sample_to_sample) {
  ViewerState state;
  state.selected = PixelPosition{10, 20};
  EXPECT_EQ(after(state, {"shift+Right", "shift+Up", "shift+Up"}).selected, (PixelPosition{11, 22}));
  state.selected = PixelPosition{0, 199};
  EXPECT_EQ(after(state, {"shift+Left", "shift+Up"}).selected, (PixelPosition{0, 199}));
  EXPECT_TRUE(after({}, {"shift+Right"}).selected.has_value());  // starts in the middle
}

TEST(ViewerKeys, escape_lets_go_of_everything) {
  ViewerState state = after({}, {"d", "h"});
  state.selected = PixelPosition{1, 1};
  state.measure.points = {{0, 1}};
  state = after(state, {"Escape"});
  EXPECT_FALSE(state.selected);
  EXPECT_FALSE(state.measure.active);
  EXPECT_TRUE(state.measure.points.empty());
  EXPECT_FALSE(state.show_help);
}

TEST(ViewerKeys, digits_choose_colours_and_angle_brackets_the_speed) {
  const SceneColour colours[] = {SceneColour::height, SceneColour::material, SceneColour::visibility,
                                 SceneColour::grazing, SceneColour::incidence};
  for (const int digit : {1, 2, 3, 4, 5})
    EXPECT_EQ(after({}, {std::to_string(digit).c_str()}).scene_colour, colours[digit - 1]) << digit;
  const double speed = ViewerState{}.pings_per_second;
  EXPECT_DOUBLE_EQ(after({}, {"greater"}).pings_per_second, 2 * speed);
  EXPECT_DOUBLE_EQ(after({}, {"less"}).pings_per_second, speed / 2);
}

TEST(ViewerKeys, one_ping_does_not_play) {
  EXPECT_FALSE(apply_key({}, "space", {1, 8, 8}).state.playing);
  EXPECT_TRUE(apply_key({}, "space", {2, 8, 8}).state.playing);
}

TEST(ViewerKeys, unknown_keys_change_nothing) {
  const ViewerState before = after({}, {"Right", "Up"});
  for (const char* key : {"F7", "x", "", "Shift_L", "7", "0"}) {
    const KeyAnswer answer = apply_key(before, key, extent);
    EXPECT_EQ(answer.state.ping, before.ping) << key;
    EXPECT_EQ(answer.state.gain_db, before.gain_db) << key;
    EXPECT_EQ(answer.state.scene_colour, before.scene_colour) << key;
    EXPECT_EQ(answer.request, ViewerRequest::none) << key;
  }
}

TEST(ViewerKeys, nothing_to_choose_from_is_no_harm) {
  for (const char* key : {"Right", "End", "shift+Right", "space", "period"}) {
    const ViewerState state = apply_key({}, key, {}).state;
    EXPECT_EQ(state.ping, 0U) << key;
    EXPECT_FALSE(state.selected) << key;
  }
}

TEST(ViewerKeys, page_keys_go_by_a_tenth_of_the_pings) {
  const ViewerExtent survey{200, 1, 10};
  EXPECT_EQ(apply_key({}, "Next", survey).state.ping, 20U);
  ViewerState late;
  late.ping = 199;
  EXPECT_EQ(apply_key(late, "Prior", survey).state.ping, 179U);
  EXPECT_EQ(apply_key(late, "Next", survey).state.ping, 199U);
}

// Every key that the tables of keys name has a button, and every button presses a key that works.
TEST(ViewerKeys, every_key_has_a_button_and_every_button_works) {
  for (const ViewerMode mode : {ViewerMode::run, ViewerMode::inspect}) {
    std::set<std::string> pressed;
    for (const ViewerKey& row : viewer_keys(mode)) {
      EXPECT_EQ(row.buttons.empty(), row.mouse == "click" || row.mouse == "drag, wheel") << row.action;
      for (const ViewerButton& button : row.buttons) EXPECT_TRUE(pressed.insert(button.key).second) << button.key;
    }
    for (const char* key : {"1", "3", "plus", "minus", "g", "n", "u", "r", "j", "h", "q"})
      EXPECT_EQ(pressed.count(key), 1U) << key;
    if (mode == ViewerMode::inspect) continue;
    for (const char* key : {"space", "Left", "Prior", "Home", "less", "Up", "bracketleft", "t", "m", "d", "shift+Left",
                            "shift+Down", "Escape", "f"})
      EXPECT_EQ(pressed.count(key), 1U) << key;
  }
}

// Every key in the help has an effect in its mode.
TEST(ViewerKeys, help_names_keys_that_work) {
  const std::set<std::string> symbols = {
      "Left", "Right",       "comma",        "period", "Home", "End", "space",      "less",     "greater", "Up",
      "Down", "bracketleft", "bracketright", "t",      "m",    "d",   "shift+Left", "shift+Up", "Escape",  "1",
      "5",    "plus",        "minus",        "g",      "u",    "r",   "j",          "h",        "q",       "e",
      "f",    "Prior",       "Next"};
  ViewerState busy;
  busy.ping = 2;
  busy.selected = PixelPosition{5, 5};
  busy.scene_colour = SceneColour::visibility;
  const auto print = [](const KeyAnswer& a) {
    const ViewerState& s = a.state;
    return testing::PrintToString(std::make_tuple(s.ping, s.selected ? s.selected->beam : 999,
                                                  s.selected ? s.selected->bin : 999, s.gain_db, s.window_db, s.tvg,
                                                  s.colour_map, s.playing)) +
           testing::PrintToString(
               std::make_tuple(s.pings_per_second, s.measure.active, static_cast<int>(s.scene_colour), s.point_size,
                               s.show_help, s.show_colour_bars, s.show_grid, s.follow, static_cast<int>(a.request)));
  };
  for (const std::string& key : symbols) EXPECT_NE(print(apply_key(busy, key, extent)), print({busy})) << key;
  for (const char* word : {"ping", "play", "gain", "window", "colour map", "measure", "screenshot", "quit"})
    EXPECT_THAT(viewer_help(ViewerMode::run), HasSubstr(word));
  for (const char* word : {"move the head", "yaw", "--pose"})
    EXPECT_THAT(viewer_help(ViewerMode::inspect), HasSubstr(word));
}

// --- playing

TEST(ViewerPlay, advances_by_time_and_comes_round) {
  ViewerState state;
  state.playing = true;
  state.pings_per_second = 4;
  double carried = 0;
  state = play_on(state, 0.1, extent, carried);
  EXPECT_EQ(state.ping, 0U);
  state = play_on(state, 0.2, extent, carried);  // 1.2 pings in all
  EXPECT_EQ(state.ping, 1U);
  EXPECT_NEAR(carried, 0.2, 1e-12);
  state = play_on(state, 1.0, extent, carried);  // 4 more of 5: wraps to the first
  EXPECT_EQ(state.ping, 0U);
  state.playing = false;
  EXPECT_EQ(play_on(state, 10, extent, carried).ping, 0U);
}

TEST(ViewerPlay, shows_every_ping_for_as_long) {
  ViewerState state;
  state.playing = true;
  double carried = 0;
  std::vector<int> shown(5, 0);
  for (int i = 0; i < 2000; ++i) {
    state = play_on(state, 0.03125, extent, carried);  // 1/8 ping
    ++shown[state.ping];
  }
  for (const int count : shown) EXPECT_EQ(count, 400);
}

// --- selecting and measuring

TEST(ViewerSelect, a_click_selects_and_a_click_outside_does_not) {
  ViewerState state = select_pixel({}, {3, 4}, {1, 2}, extent);
  EXPECT_EQ(state.selected, (PixelPosition{3, 4}));
  EXPECT_EQ(select_pixel(state, {64, 4}, {0, 0}, extent).selected, (PixelPosition{3, 4}));
  EXPECT_EQ(select_pixel(state, {3, 200}, {0, 0}, extent).selected, (PixelPosition{3, 4}));
}

TEST(ViewerSelect, two_clicks_measure_a_distance_and_leave_the_selection) {
  ViewerState state = select_pixel({}, {3, 4}, {0, 0}, extent);
  state = after(state, {"d"});
  state = select_pixel(state, {5, 6}, {1, 1}, extent);
  EXPECT_EQ(state.measure.length(), 0);
  state = select_pixel(state, {7, 8}, {4, 5}, extent);
  EXPECT_DOUBLE_EQ(state.measure.length(), 5);  // 3-4-5
  EXPECT_EQ(state.selected, (PixelPosition{3, 4}));
  // The second click ends it: the next one selects, and the length stays.
  EXPECT_FALSE(state.measure.active);
  state = select_pixel(state, {7, 8}, {0, 0}, extent);
  EXPECT_EQ(state.selected, (PixelPosition{7, 8}));
  EXPECT_DOUBLE_EQ(state.measure.length(), 5);
  state = after(state, {"d"});
  EXPECT_TRUE(state.measure.active && state.measure.points.empty());  // a new measurement
}

TEST(ViewerSelect, a_click_on_a_waterfall_goes_to_its_ping) {
  ViewerState state;
  state.playing = true;
  state = select_ping(state, 3, {0, 7}, extent);
  EXPECT_EQ(state.ping, 3U);
  EXPECT_EQ(state.selected, (PixelPosition{0, 7}));
  EXPECT_FALSE(state.playing);
  EXPECT_EQ(select_ping(state, 5, {0, 7}, extent).ping, 3U);  // there are five
}

// --- the head
