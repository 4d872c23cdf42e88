// SPDX-License-Identifier: BSD-3-Clause
#include "files/pending_file.hpp"
#include "support/test.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowFan : public PictureTest {
 protected:
  ShowFan() { options.title = "Test"; }
  ReadPicture show(const LevelImage& image) {
    show_fan(image, options, path);
    return read_png(path);
  }
  FanLayout layout_of(const LevelImage& image) const {
    const BeamCells cells = order_beams(image);
    const double max_range = image.gate.min_range + static_cast<double>(image.level_db.cols()) * image.gate.bin_size;
    return lay_out_fan({cells.low(), cells.high(), image.gate.min_range, max_range, image.downwards}, options,
                       colour_scale(image.level_db, options, "test"), image.unit);
  }
};

// Nine beams 10 degrees apart and 20 bins of 0.5 m from 1 m, dark except three cells of different levels: port
// near (azimuth +30 degrees, 2.75 m), starboard far (azimuth -30 degrees, 9.75 m) and ahead (6.25 m).
struct ThreeCells {
  explicit ThreeCells(bool port_first) : image(flat_image(9, 90, 20, -200, port_first)) {
    set(30, 3, port_db);
    set(-30, 17, starboard_db);
    set(0, 10, ahead_db);
  }
  void set(double azimuth_deg, Eigen::Index bin, float db) {
    for (std::size_t b = 0; b < 9; ++b)
      if (std::abs(image.fan.azimuth[b] - radians(azimuth_deg)) < 0.01)
        image.level_db(static_cast<Eigen::Index>(b), bin) = db;
  }

  static constexpr float port_db = 72, starboard_db = 84, ahead_db = 96;
  LevelImage image;
};

std::string message_of(const LevelImage& image, const PictureOptions& options, const std::string& path,
                       ErrorKind kind) {
  return error_of([&] { show_fan(image, options, path); }, kind);
}

}  // namespace

TEST_F(ShowFan, comes_out_in_the_size_asked_for_without_a_screen) {
  for (const auto& [width, height] : {std::pair{600, 500}, std::pair{777, 431}, std::pair{1400, 1050}}) {
    options.width = width, options.height = height;
    const ReadPicture picture = show(flat_image(32, 130, 50, 90));
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
  }
}

TEST_F(ShowFan, cuts_off_what_a_wide_fan_leaves_free_above_and_a_narrow_one_beside) {
  options = {};
  options.trim = true;
  const ReadPicture wide = show(flat_image(32, 130, 50, 90)), narrow = show(flat_image(32, 45, 50, 90));
  EXPECT_EQ(wide.width, 1400);
  EXPECT_LT(wide.height, 960);
  EXPECT_EQ(narrow.height, 1050);
  EXPECT_LT(narrow.width, 1100);
  for (const int size : {wide.height, narrow.width}) EXPECT_EQ(size % 2, 0) << "films take even sizes alone";
}

// A head that looks down is at the top, and starboard is still right.
TEST_F(ShowFan, has_starboard_right_and_forward_up_whatever_the_order_of_the_beams) {
  options.min_db = 50, options.max_db = 100;
  options.colour_map = "jet";
  for (const auto& [port_first, downwards] : {std::pair{false, false}, {true, false}, {true, true}}) {
    ThreeCells cells(port_first);
    cells.image.downwards = downwards;
    const ReadPicture picture = show(cells.image);
    const FanLayout layout = layout_of(cells.image);
    const ColourScale scale = colour_scale(cells.image.level_db, options, "test");
    const double bar = layout.colour_bar.outer().top, up = downwards ? -1 : 1;
    ASSERT_TRUE(layout.colour_bar.lying) << "below a wide fan";
    const auto find = [&](double db) { return find_colour(picture, scale.colour(db), 0, 1e9, bar, 1e9); };
    const Blob port = find(ThreeCells::port_db), starboard = find(ThreeCells::starboard_db);
    const Blob ahead = find(ThreeCells::ahead_db);
    for (const Blob& blob : {port, starboard, ahead}) ASSERT_GT(blob.pixels, 100);

    // From the picture alone: the order across and upwards, and the geometry 2.75 : 9.75 : 6.25 m at -30, 30,
    // 0 degrees.
    EXPECT_LT(port.x, ahead.x);
    EXPECT_GT(starboard.x, ahead.x);
    EXPECT_LT(up * port.y, up * ahead.y);
    EXPECT_LT(up * ahead.y, up * starboard.y);
    EXPECT_NEAR((starboard.x - ahead.x) / (ahead.x - port.x), 9.75 / 2.75, 0.05);
    EXPECT_NEAR((starboard.y - port.y) / (ahead.y - port.y),
                7 * std::cos(radians(30)) / (6.25 - 2.75 * std::cos(radians(30))), 0.05);

    // Compare with the positions of the layout.
    const Point2 p = layout.at(radians(-30), 2.75), s = layout.at(radians(30), 9.75), a = layout.at(0, 6.25);
    EXPECT_LT(std::hypot(port.x - p.x, port.y - p.y), 2);
    EXPECT_LT(std::hypot(starboard.x - s.x, starboard.y - s.y), 2);
    EXPECT_LT(std::hypot(ahead.x - a.x, ahead.y - a.y), 2);
    const Point2 back = layout.from_apex(s);
    EXPECT_NEAR(std::atan2(back.x, back.y), radians(30), 1e-12);
  }
}

TEST_F(ShowFan, shows_every_cell_in_the_colour_of_its_level) {
  options.min_db = 0, options.max_db = 179;
  for (const std::string& map : colour_map_names()) {
    options.colour_map = map;
    LevelImage image = flat_image(9, 90, 20, 0);
    for (Eigen::Index i = 0; i < 180; ++i) image.level_db.data()[i] = static_cast<float>(i);
    const ReadPicture picture = show(image);
    const FanLayout layout = layout_of(image);
    const ColourScale scale = colour_scale(image.level_db, options, "test");
    for (Eigen::Index beam = 0; beam < 9; ++beam)
      for (Eigen::Index bin = 2; bin < 20; ++bin) {
        // Avoid the centre of the cell, where spokes and rings are.
        const double bearing = -image.fan.azimuth[static_cast<std::size_t>(beam)] + radians(2);
        const double range = image.gate.centre(static_cast<std::size_t>(bin)) + 0.1;
        const Point2 p = layout.at(bearing, range);
        EXPECT_LE(colour_difference(picture.at(p.x, p.y), scale.colour(image.level_db(beam, bin))), 2)
            << map << ", beam " << beam << ", bin " << bin;
      }
  }
}

TEST_F(ShowFan, has_a_colour_bar_that_runs_through_the_colour_map) {
  options.colour_map = "viridis";
  for (const double field_of_view_deg : {60.0, 150.0}) {
    const LevelImage image = flat_image(16, field_of_view_deg, 40, 90);
    const ReadPicture picture = show(image);
    const ColourBar bar = layout_of(image).colour_bar;
    EXPECT_EQ(bar.lying, field_of_view_deg > 100);
    const ColourTable table = colour_table("viridis", "test");
    for (std::size_t i = 2; i < 254; ++i) {
      const double along = (static_cast<double>(i) + 0.5) / 256;
      const Rgb seen = bar.lying
                           ? picture.at(bar.bar.left + along * bar.bar.width(), bar.bar.bottom + bar.bar.height() / 2)
                           : picture.at(bar.bar.left + bar.bar.width() / 2, bar.bar.bottom + along * bar.bar.height());
      EXPECT_LE(colour_difference(seen, table[i]), 6) << i;  // one entry of the table is up to 6 from the next
    }
  }
}

TEST_F(ShowFan, of_one_beam_shows_that_beam) {
  options.colour_map = "grey";
  options.min_db = 0, options.max_db = 100;
  LevelImage image = flat_image(1, 10, 30, 60);
  image.fan.beam_width = radians(8);
  const ReadPicture picture = show(image);
  const Point2 p = layout_of(image).at(radians(2), 12.3);
  EXPECT_LE(colour_difference(picture.at(p.x, p.y), colour_scale(image.level_db, options, "test").colour(60)), 2);
}

TEST_F(ShowFan, of_a_full_circle_has_no_seam) {
  options.colour_map = "grey";
  options.min_db = 0, options.max_db = 100;
  LevelImage image = flat_image(400, 360, 40, 60);
  const ReadPicture picture = show(image);
  const FanLayout layout = layout_of(image);
  const Rgb cell = colour_scale(image.level_db, options, "test").colour(60);
  int seen = 0;
  for (double bearing_deg = -180.25; bearing_deg < 180; bearing_deg += 0.5) {
    const Point2 p = layout.at(radians(bearing_deg), 18.6);
    bool covered = std::abs(std::remainder(bearing_deg, 30)) < 1;  // by a spoke, or by a range label
    for (const PlacedText& text : layout.texts) covered |= text.box().contains({p.x, p.x, p.y, p.y});
    if (covered) continue;
    ++seen;
    EXPECT_LE(colour_difference(picture.at(p.x, p.y), cell), 2) << bearing_deg;
  }
  EXPECT_GT(seen, 600);
}

// 8000 bins on some 800 pixels, one of them bright: if one in ten were drawn, it would be lost nine times in ten.
TEST_F(ShowFan, does_not_lose_a_bright_bin_among_many) {
  options.colour_map = "grey";
  options.min_db = 0, options.max_db = 100;
  for (const Eigen::Index bin : {4000, 4003, 4007}) {
    LevelImage image = flat_image(8, 60, 8000, -200);
    image.level_db.col(bin) = 100;
    const ReadPicture picture = show(image);
    const FanLayout layout = layout_of(image);
    int brightest = 0;
    for (double pixels = -4; pixels <= 4; pixels += 0.5) {
      const Point2 p =
          layout.at(radians(4), image.gate.centre(static_cast<std::size_t>(bin)) + pixels / layout.pixels_per_metre);
      brightest = std::max(brightest, int{picture.at(p.x, p.y)[0]});
    }
    EXPECT_GT(brightest, 100) << bin;
  }
}

TEST_F(ShowFan, of_nothing_but_floor_is_drawn_in_the_lowest_colour) {
  const LevelImage image = flat_image(32, 90, 40, -200);
  options.colour_map = "viridis";
  const ReadPicture picture = show(image);
  const Point2 p = layout_of(image).at(radians(7), 11.3);
  EXPECT_LE(colour_difference(picture.at(p.x, p.y), {0x44, 0x01, 0x54}), 2);
}

TEST_F(ShowFan, prints_nothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  show_fan(flat_image(32, 90, 40, 0), options, path);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(ShowFan, refuses_an_unknown_colour_map) {
  options.colour_map = "rainbow";
  EXPECT_THAT(message_of(flat_image(4, 60, 10, 0), options, path, ErrorKind::argument),
              HasSubstr("show_fan: options.colour_map = \"rainbow\", must be one of viridis"));
  EXPECT_FALSE(file_exists(path));
}

TEST_F(ShowFan, that_cannot_be_written_leaves_nothing_behind) {
  const LevelImage image = flat_image(4, 60, 10, 0);
  const std::string nowhere = own_path("no_such_folder") + "/fan.png";
  EXPECT_THAT(message_of(image, options, nowhere, ErrorKind::file), HasSubstr(nowhere + ": folder "));

  const std::string folder = own_path("folder.png");
  std::filesystem::create_directories(folder + "/full");
  EXPECT_THAT(message_of(image, options, folder, ErrorKind::file), HasSubstr(folder + ": is not a valid name"));
  EXPECT_FALSE(file_exists(sibling_name(folder)));
  std::filesystem::remove_all(folder);

  // /dev/full behaves like a full disk.
  if (file_exists("/dev/full")) {
    std::filesystem::create_symlink("/dev/full", sibling_name(path));
    EXPECT_THAT(message_of(image, options, path, ErrorKind::file), HasSubstr("is the disk full"));
    EXPECT_FALSE(std::filesystem::is_symlink(sibling_name(path)));
    EXPECT_FALSE(file_exists(path));
  }
}

// Runs in a separate process in which the GL library finds no driver.
TEST(ShowFanDeathTest, without_a_gl_driver_says_what_to_install) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto draw = [] {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
    try {
      show_fan(flat_image(4, 60, 10, 0), {}, "never.png");
    } catch (const Error& error) {
      std::fprintf(stderr, "%s", error.what());
      std::_Exit(error.kind() == ErrorKind::runtime ? 3 : 4);
    }
    std::_Exit(5);
  };
  EXPECT_EXIT(draw(), testing::ExitedWithCode(3),
              "show_fan: no off-screen OpenGL.*install libegl1 and libgl1-mesa-dri");
}
