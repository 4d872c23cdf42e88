// SPDX-License-Identifier: BSD-3-Clause
// Tests the whole window, drawn off-screen: clicks and keys change the state, and the drawing follows it.
#include "support/test.hpp"
#include "view/test_pictures.hpp"
#include "viewer/three_targets.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace {

class WindowFixture : public testing::Test {
 protected:
  void open(ViewerOptions options = {}) {
    options.width = 800, options.height = 600;
    options.say = [this](const std::string& text) { said_.push_back(text); };
    window_.reset();  // one window at a time, since each holds VTK's messages
    window_ = std::make_unique<ViewerWindow>(made_.data, options, ViewerScreen::off_screen);
    window_->run(options.events);
  }
  ViewerEvent click_at(Point2 position, ViewerPanelName panel) const {
    const Box& box = box_of(window_->layout(), panel);
    ViewerEvent event;
    event.kind = ViewerEvent::Kind::click;
    event.panel = panel;
    event.from = {position.x - box.left, position.y - box.bottom};
    return event;
  }
  ViewerEvent drag_from(Point2 position, Point2 by, ViewerPanelName panel) const {
    ViewerEvent event = click_at(position, panel);
    event.kind = ViewerEvent::Kind::drag;
    event.by = by;
    return event;
  }
  Point2 middle(ViewerPanelName panel) const {
    const Box& box = box_of(window_->layout(), panel);
    return {(box.left + box.right) / 2, (box.bottom + box.top) / 2};
  }
  ReadPicture picture(const std::string& name) {
    const std::string path = own_path(name);
    window_->save_png(path);
    ReadPicture read = read_png(path);
    return read;
  }
  // Counts the pixels that differ between two pictures within a box.
  static int differences(const ReadPicture& a, const ReadPicture& b, const Box& box) {
    int count = 0;
    for (double x = box.left + 0.5; x < box.right; ++x)
      for (double y = box.bottom + 0.5; y < box.top; ++y) count += colour_difference(a.at(x, y), b.at(x, y)) > 12;
    return count;
  }

  TargetData made_ = three_targets(1, false);
  std::unique_ptr<ViewerWindow> window_;
  std::vector<std::string> said_;
};

}  // namespace

TEST_F(WindowFixture, a_click_on_a_target_selects_its_sample_and_explains_it) {
  open();
  for (const auto* target : {&made_.port, &made_.starboard, &made_.far}) {
    window_->play(click_at(window_->pixel_of(target->pixel), ViewerPanelName::fan));
    EXPECT_EQ(window_->state().selected, target->pixel) << target->name;
    ASSERT_FALSE(said_.empty());
    EXPECT_THAT(said_.back(), HasSubstr(target->name));
  }
}

// Finds the bright cell in the picture itself, independently of the layout.
TEST_F(WindowFixture, targets_are_drawn_where_clicks_find_them) {
  ViewerOptions options;
  options.start.colour_map = "grey";
  open(options);
  const Box& fan = window_->layout().fan;
  const auto read = picture("viewer_targets.png");
  const auto centre_of = [&](double left, double right, double bottom, double top) {
    double x = 0, y = 0, n = 0;
    for (double px = left + 0.5; px < right; ++px)
      for (double py = bottom + 0.5; py < top; ++py) {
        const Rgb c = read.at(px, py);
        if (c[0] < 215 || c[1] < 215) continue;
        x += px, y += py, ++n;
      }
    return std::pair(Point2{x / n, y / n}, n);
  };
  for (const auto* target : {&made_.port, &made_.starboard, &made_.far}) {
    const Point2 at = window_->pixel_of(target->pixel);
    const auto [found, pixels] = centre_of(at.x - 12, at.x + 12, at.y - 12, at.y + 12);
    EXPECT_GT(pixels, 1) << target->name;
    EXPECT_NEAR(found.x, at.x, 1.5) << target->name;
    EXPECT_NEAR(found.y, at.y, 1.5) << target->name;
  }
  // Port left, starboard right, far above near.
  const Point2 port = window_->pixel_of(made_.port.pixel), starboard = window_->pixel_of(made_.starboard.pixel);
  EXPECT_LT(port.x, window_->pixel_of(made_.far.pixel).x);
  EXPECT_GT(starboard.x, window_->pixel_of(made_.far.pixel).x);
  EXPECT_GT(window_->pixel_of(made_.far.pixel).y, port.y + 0.2 * fan.height());
}

TEST_F(WindowFixture, clicks_find_the_same_cell_after_the_fan_was_moved_and_zoomed) {
  open();
  const Point2 before = window_->pixel_of(made_.port.pixel);
  window_->play(drag_from(middle(ViewerPanelName::fan), {40, -25}, ViewerPanelName::fan));
  const Point2 after = window_->pixel_of(made_.port.pixel);
  EXPECT_NEAR(after.x - before.x, 40, 1);
  EXPECT_NEAR(after.y - before.y, -25, 1);
  const Point2 at = middle(ViewerPanelName::fan);
  window_->interactor()->SetEventInformation(static_cast<int>(at.x), static_cast<int>(at.y));
  window_->interactor()->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  EXPECT_GT(std::abs(window_->pixel_of(made_.port.pixel).x - at.x), std::abs(after.x - at.x));
  window_->play(click_at(window_->pixel_of(made_.port.pixel), ViewerPanelName::fan));
  EXPECT_EQ(window_->state().selected, made_.port.pixel);
  window_->press_key("Up");  // redrawn with the user's camera
  EXPECT_NE(window_->pixel_of(made_.port.pixel).x, before.x);
  window_->press_key("r");
  EXPECT_NEAR(window_->pixel_of(made_.port.pixel).x, before.x, 1e-6);
}

TEST_F(WindowFixture, a_drag_is_no_click) {
  open();
  window_->play(drag_from(window_->pixel_of(made_.port.pixel), {30, 0}, ViewerPanelName::fan));
  EXPECT_FALSE(window_->state().selected);
  EXPECT_TRUE(said_.empty());
}

TEST_F(WindowFixture, a_click_on_a_target_in_3d_selects_its_sample) {
  open();
  for (const auto* target : {&made_.port, &made_.starboard, &made_.far}) {
    const auto at = window_->pixel_of_point(target->position);
    ASSERT_TRUE(at);
    window_->play(click_at(*at, ViewerPanelName::scene));
    EXPECT_EQ(window_->state().selected, target->pixel) << target->name;
  }
  // Seen from behind the head, port is left and starboard right.
  EXPECT_LT(window_->pixel_of_point(made_.port.position)->x, window_->pixel_of_point(made_.starboard.position)->x);
}

TEST_F(WindowFixture, a_click_on_the_ascan_keeps_the_beam_and_takes_the_range) {
  ViewerOptions options;
  options.start.selected = made_.port.pixel;
  open(options);
  window_->play(click_at(middle(ViewerPanelName::ascan), ViewerPanelName::ascan));
  ASSERT_TRUE(window_->state().selected);
  EXPECT_EQ(window_->state().selected->beam, made_.port.pixel.beam);
  EXPECT_NEAR(static_cast<double>(window_->state().selected->bin), 60, 12);  // near the middle of the gate
}

TEST_F(WindowFixture, two_clicks_measure_the_distance_between_two_targets) {
  open();
  window_->press_key("d");
  window_->play(click_at(window_->pixel_of(made_.port.pixel), ViewerPanelName::fan));
  window_->play(click_at(window_->pixel_of(made_.starboard.pixel), ViewerPanelName::fan));
  // Both at 6.05 m, 52 degrees apart: 2 x 6.05 sin 26 degrees.
  EXPECT_NEAR(window_->state().measure.length(), 2 * 6.05 * std::sin(radians(26)), 0.05);
  EXPECT_FALSE(window_->state().selected);
}

TEST_F(WindowFixture, keys_change_what_is_drawn) {
  made_ = three_targets(3);
  open();
  const Box whole{0, 800, 0, 600};
  auto before = picture("viewer_before.png");
  for (const char* key : {"m", "t", "bracketright", "Up", "h", "h", "Right", "2", "u", "g"}) {
    window_->press_key(key);
    const auto after = picture("viewer_after.png");
    EXPECT_GT(differences(before, after, whole), 30) << key;
    before = after;
  }
}

TEST_F(WindowFixture, the_same_state_is_drawn_the_same_way_whatever_came_before) {
  made_ = three_targets(3);
  open();
  const auto before = picture("viewer_before.png");
  for (std::size_t map = 0; map < colour_map_names().size(); ++map) window_->press_key("m");
  for (const char* key : {"t", "t", "Up", "Down", "Right", "Left", "h", "h", "u", "u", "g", "g"})
    window_->press_key(key);
  EXPECT_EQ(differences(before, picture("viewer_after.png"), {0, 800, 0, 600}), 0);
}

TEST_F(WindowFixture, the_slider_sets_the_gain) {
  open();
  // Ends of the slider's tube; a press on the tube moves the slider there.
  const Box& facts = window_->layout().facts;
  const double font = window_->layout().font_size;
  const double left = facts.left + 2 * font, right = facts.right - 2 * font;
  const double height = facts.bottom + 0.5 * font + 0.75 * 11.5 * font;
  window_->play(click_at({left + 0.75 * (right - left), height}, ViewerPanelName::facts));
  EXPECT_NEAR(window_->state().gain_db, 20, 4);  // three quarters of the way from -40 to 40
}

TEST_F(WindowFixture, playing_moves_on_by_itself) {
  made_ = three_targets(64);  // too many to wrap around in the time
  ViewerOptions options;
  options.events = parse_viewer_script("key space; wait 0.6; key space");
  open(options);
  EXPECT_GE(window_->state().ping, 2U);  // 4 a second
  EXPECT_FALSE(window_->state().playing);
}

TEST_F(WindowFixture, quits_on_request) {
  ViewerOptions options;
  options.events = parse_viewer_script("key q; key Up");
  open(options);
  EXPECT_TRUE(window_->finished());
  EXPECT_EQ(window_->state().gain_db, 0);
}

TEST_F(WindowFixture, inspects_a_scene_and_says_its_pose) {
  const Ping ping = made_.pings[0];
  made_.data.pings = {};
  made_.data.fan = ping.fan;
  made_.data.gate = ping.gate;
  ViewerOptions options;
  options.start.mode = ViewerMode::inspect;
  options.start.head = pose_angles(ping.world_from_head);
  options.start.scene_colour = SceneColour::visibility;
  open(options);
  EXPECT_THAT(window_->explanation(), HasSubstr("75 seen"));
  window_->press_key("p");
  ASSERT_FALSE(said_.empty());
  EXPECT_EQ(said_.back(), "--pose=10,20,-3,30,0,0");
  window_->press_key("Prior");
  window_->press_key("p");
  EXPECT_EQ(said_.back(), "--pose=10,20,-2.5,30,0,0");
  const auto at = window_->pixel_of_point(made_.far.position);
  window_->play(click_at(*at, ViewerPanelName::scene));
  EXPECT_THAT(said_.back(), HasSubstr("rubber"));
  for (int i = 0; i < 20; ++i) window_->press_key("shift+Left");
  EXPECT_THAT(window_->explanation(), HasSubstr(" 0 seen"));
}

TEST_F(WindowFixture, a_run_without_scene_shows_its_fan_alone) {
  made_.data.scene = {};
  open();
  EXPECT_EQ(window_->layout().scene.width(), 0);
  window_->play(click_at(window_->pixel_of(made_.port.pixel), ViewerPanelName::fan));
  EXPECT_EQ(window_->state().selected, made_.port.pixel);
}

TEST_F(WindowFixture, refuses_what_cannot_be_shown) {
  const auto refuses = [&](const ViewerData& data, const ViewerOptions& options, ErrorKind kind = ErrorKind::argument) {
    return error_of([&] { ViewerWindow window(data, options, ViewerScreen::off_screen); }, kind);
  };
  ViewerOptions options;
  options.start.ping = 1;
  EXPECT_THAT(refuses(made_.data, options), HasSubstr("ping = 1, must be below 1"));
  options.start.ping = 0;
  options.width = 300;
  EXPECT_THAT(refuses(made_.data, options), HasSubstr("window of 300 x 1000 pixels"));
  EXPECT_THAT(refuses({}, {}, ErrorKind::content), HasSubstr("no pings"));
  ViewerData uneven = made_.data;
  made_.pings[0].pressure.resize(3, 3);
  uneven.pings = reel_in_memory(made_.pings);
  EXPECT_THAT(refuses(uneven, {}, ErrorKind::content), HasSubstr("3 x 3 samples"));
}

// A scene whose parts move from ping to ping is drawn, clicked, explained and coloured at the time of the ping.
TEST_F(WindowFixture, a_scene_that_moves_is_that_of_the_ping) {
  made_ = three_targets(3);
  SceneCloud& scene = made_.data.scene;
  scene.parts = {{.name = "plates"}, {.name = "swimmer"}};
  scene.part.assign(scene.size(), 0);
  std::fill_n(scene.part.begin(), 25, 1);  // the port target
  const auto first = std::make_shared<const SceneCloud>(scene);
  SceneCloud moved = scene;
  const Eigen::Vector3d by =
      made_.starboard.position + (made_.far.position - made_.starboard.position) / 2 - made_.port.position;
  for (std::size_t i = 0; i < 25; ++i) moved.point[i] += by.cast<float>();
  const auto second = std::make_shared<const SceneCloud>(std::move(moved));
  scene = {};
  made_.data.scene_of_ping = [&](std::size_t ping) { return ping == 1 ? second : first; };
  const Eigen::Vector3d now = made_.port.position + by;
  const auto there = position_of(made_.pings[1], now);
  ASSERT_TRUE(there);

  open();
  window_->press_key("6");
  const ReadPicture before = picture("before.png");
  EXPECT_THAT(surfels_behind(find_pixel_facts(made_.data, 1, *there)), testing::Contains(12U));
  EXPECT_TRUE(surfels_behind(find_pixel_facts(made_.data, 0, *there)).empty());
  const auto click_world = [&](const Eigen::Vector3d& world) {
    window_->press_key("Escape");
    window_->play(click_at(*window_->pixel_of_point(world), ViewerPanelName::scene));
    return window_->state().selected;
  };
  EXPECT_FALSE(click_world(now)) << "not there yet";
  window_->press_key("Right");
  EXPECT_FALSE(click_world(made_.port.position)) << "there no more";
  ASSERT_TRUE(click_world(now));
  EXPECT_EQ(window_->state().selected, there);
  EXPECT_THAT(window_->explanation(), HasSubstr("Part swimmer"));
  window_->press_key("Escape");
  window_->press_key("Right");
  EXPECT_EQ(differences(before, picture("after.png"), window_->layout().scene_view), 0) << "back at its place";
}
