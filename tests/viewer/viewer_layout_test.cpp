// SPDX-License-Identifier: BSD-3-Clause
// Layout of the panels, picking, and parsing of events.
#include "viewer/viewer_layout.hpp"

#include "support/test.hpp"
#include "view/drawn_cells_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_flat_panels_internal.hpp"
#include "viewer/viewer_script.hpp"

namespace {

constexpr ViewerPanelName all[] = {ViewerPanelName::fan,     ViewerPanelName::scene, ViewerPanelName::ascan,
                                   ViewerPanelName::history, ViewerPanelName::facts, ViewerPanelName::timeline,
                                   ViewerPanelName::status};

std::string refused(const std::string& script) {
  return error_of([&] { parse_viewer_script(script); });
}

}  // namespace

TEST(ViewerLayout, panels_tile_the_window) {
  for (const auto& [width, height] : {std::pair{800, 600}, {1600, 1000}, {1201, 1777}, {3840, 2160}})
    for (const ViewerMode mode : {ViewerMode::run, ViewerMode::inspect})
      for (const int parts : {0, 1, 2, 3, 4, 5, 6, 7}) {
        const bool with_scene = (parts & 1) != 0, with_history = (parts & 2) != 0, with_timeline = (parts & 4) != 0;
        if (mode == ViewerMode::inspect && !with_scene) continue;
        const ViewerLayout layout =
            lay_out_viewer(width, height, mode, {with_scene, with_history, with_timeline, true});
        double area = 0;
        for (const ViewerPanelName a : all) {
          const Box& box = box_of(layout, a);
          area += box.width() * box.height();
          for (const ViewerPanelName b : all) EXPECT_TRUE(a == b || !box.overlaps(box_of(layout, b)));
        }
        EXPECT_DOUBLE_EQ(area, 1.0 * width * height);
      }
}

TEST(ViewerLayout, every_place_belongs_to_the_panel_drawn_there) {
  const ViewerLayout layout = lay_out_viewer(1600, 1000, ViewerMode::run, {true, true, true, true});
  for (const ViewerPanelName name : all) {
    const Box& box = box_of(layout, name);
    EXPECT_EQ(panel_at(layout, {(box.left + box.right) / 2, (box.bottom + box.top) / 2}), name);
    EXPECT_EQ(panel_at(layout, {box.left, box.bottom}), name);
  }
  EXPECT_FALSE(panel_at(layout, {1600, 500}));
  EXPECT_FALSE(panel_at(layout, {-1, 500}));
}

TEST(ViewerLayout, the_key_of_the_scene_stands_beside_it) {
  const ViewerLayout with = lay_out_viewer(1600, 1000, ViewerMode::run, {});
  EXPECT_EQ(with.scene_view.left, with.scene.left);
  EXPECT_GT(with.scene.right - with.scene_view.right, 10 * with.font_size);
  EXPECT_GT(with.scene_view.width(), with.scene.width() / 2);
  const ViewerLayout without = lay_out_viewer(1600, 1000, ViewerMode::run, {true, true, false, false});
  EXPECT_EQ(without.scene_view.right, without.scene.right);
}

TEST(ViewerLayout, refuses_a_window_too_small_to_read) {
  EXPECT_THROW(lay_out_viewer(799, 600, ViewerMode::run, {}), Error);
  EXPECT_THROW(lay_out_viewer(800, 8193, ViewerMode::run, {}), Error);
}

// --- picking

class FanPicking : public testing::Test {
 protected:
  LevelImage image_ = [] {
    LevelImage image{make_fan(41, radians(82), radians(2), radians(20)), {2, 14, 0.1}, {}, "dB"};
    image.level_db = Grid<float>::Constant(41, 120, 60);
    return image;
  }();
  FanLayout layout_ = [this] {
    const BeamCells cells = order_beams(image_);
    PictureOptions options;
    options.width = 700, options.height = 600;
    return lay_out_fan({cells.low(), cells.high(), 2, 14}, options, colour_scale(image_.level_db, options, "test"),
                       "dB");
  }();
};

TEST_F(FanPicking, every_cell_is_found_at_its_middle) {
  for (std::size_t beam = 0; beam < 41; ++beam)
    for (std::size_t bin = 0; bin < 120; ++bin) {
      const Point2 middle = layout_.at(-image_.fan.azimuth[beam], image_.gate.centre(bin));
      ASSERT_EQ(pixel_at(image_, fan_position(layout_, middle)), (PixelPosition{beam, bin})) << beam << " " << bin;
    }
}

TEST_F(FanPicking, starboard_is_right_and_far_is_up) {
  const auto at = [&](double x, double y) {
    return pixel_at(image_, fan_position(layout_, {layout_.apex.x + x, layout_.apex.y + y}));
  };
  const auto left = at(-40, 200), right = at(40, 200), above = at(0, 300);
  ASSERT_TRUE(left && right && above);
  EXPECT_GT(image_.fan.azimuth[left->beam], 0);  // positive azimuth is to port
  EXPECT_LT(image_.fan.azimuth[right->beam], 0);
  EXPECT_GT(above->bin, left->bin);
}

TEST_F(FanPicking, nothing_is_found_outside_the_fan) {
  for (const auto& [bearing_deg, range] : {std::pair{0.0, 1.99}, {0.0, 14.01}, {41.1, 8.0}, {-41.1, 8.0}, {180.0, 8.0}})
    EXPECT_FALSE(pixel_at(image_, {radians(bearing_deg), range})) << bearing_deg << " " << range;
}

TEST_F(FanPicking, a_full_circle_has_no_seam) {
  image_.fan = make_fan(41, 2 * pi, radians(9), radians(20));
  for (const double bearing_deg : {-179.9, 179.9, 90.0, -90.0, 0.0})
    EXPECT_TRUE(pixel_at(image_, {radians(bearing_deg), 8.0})) << bearing_deg;
}

TEST_F(FanPicking, of_beams_one_above_another_the_strongest_is_found) {
  image_.fan.azimuth[11] = image_.fan.azimuth[10];
  image_.fan.elevation[11] = radians(10);
  image_.level_db(11, 50) = 80;
  const FanPosition at{-image_.fan.azimuth[10], image_.gate.centre(50)};
  EXPECT_EQ(pixel_at(image_, at), (PixelPosition{11, 50}));
  image_.level_db(10, 50) = 90;
  EXPECT_EQ(pixel_at(image_, at), (PixelPosition{10, 50}));
}

TEST_F(FanPicking, metres_are_to_starboard_and_forward) {
  EXPECT_TRUE(metres_on_fan({radians(90), 3}).isApprox(Eigen::Vector2d(3, 0), 1e-12));
  EXPECT_TRUE(metres_on_fan({0, 3}).isApprox(Eigen::Vector2d(0, 3), 1e-12));
}

TEST_F(FanPicking, a_range_on_the_chart_is_its_bin) {
  const Axes axes{{100, 580, 50, 300}, 2, 14, 0, 60, {}, {}, {}};
  EXPECT_EQ(bin_at(image_, axes, {100 + 480 * (image_.gate.centre(30) - 2) / 12, 200}), 30U);
  EXPECT_FALSE(bin_at(image_, axes, {99, 200}));
  EXPECT_FALSE(bin_at(image_, axes, {300, 301}));
}

// --- events

TEST(ViewerScript, reads_every_event) {
  const auto events = parse_viewer_script(
      "click fan 120 300; key shift+Up ;select 3 4\n# a comment\ndrag scene 10 20 -5 6; wait 0.5; screenshot "
      "a.png;quit");
  ASSERT_EQ(events.size(), 7U);
  EXPECT_EQ(events[0].kind, ViewerEvent::Kind::click);
  EXPECT_EQ(events[0].panel, ViewerPanelName::fan);
  EXPECT_EQ(events[0].from.y, 300);
  EXPECT_EQ(events[1].text, "shift+Up");
  EXPECT_EQ(events[2].position, (PixelPosition{3, 4}));
  EXPECT_EQ(events[3].panel, ViewerPanelName::scene);
  EXPECT_EQ(events[3].by.x, -5);
  EXPECT_EQ(events[4].seconds, 0.5);
  EXPECT_EQ(events[5].text, "a.png");
  EXPECT_EQ(events[6].kind, ViewerEvent::Kind::quit);
  EXPECT_TRUE(parse_viewer_script(" ;\n# nothing\n").empty());
}

TEST(ViewerScript, refuses_what_it_cannot_do) {
  EXPECT_THAT(refused("push fan 1 2"), HasSubstr("no event is called 'push'"));
  EXPECT_THAT(refused("click attic 1 2"), HasSubstr("no panel is called 'attic'"));
  EXPECT_THAT(refused("click fan 1"), HasSubstr("pixels from below"));
  EXPECT_THAT(refused("click fan 1 two"), HasSubstr("needs a number"));
  EXPECT_THAT(refused("key"), HasSubstr("name of a key"));
  EXPECT_THAT(refused("select -1 2"), HasSubstr("must be 0, 1"));
  EXPECT_THAT(refused("wait 1e9"), HasSubstr("0 to 3600"));
  EXPECT_THAT(refused("quit now"), HasSubstr("too much"));
}
