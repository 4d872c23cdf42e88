// SPDX-License-Identifier: BSD-3-Clause
// Reads back what `export --to gsf|las|geotiff|csv|png` writes of a ball to port of the head, ahead of it and above the
// bed, with the decoders of tests/formats: unit and sign of every field.
#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include "core/geodesy.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/las_decoder.hpp"
#include "formats/tiff_decoder.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/scenes.hpp"
#include "support/vtk_file.hpp"
#include "tool/ball_fixture.hpp"

TEST_F(ExportProducts, gsf_has_the_ball_to_port_ahead_and_at_its_depth) {
  succeed("export out --to gsf --anchor 54.1,7.9,90 --start-utc 2026-05-01T08:30:00Z -o ball.gsf -q");
  const decode::GsfContent read = decode::read_gsf(read_bytes("ball.gsf"));
  ASSERT_EQ(read.swaths.size(), 1U);
  const decode::GsfSwath& s = read.swaths[0];
  EXPECT_NEAR(s.time, 1777624200, 1e-6);
  const GeoPosition head = geo_from_world(ball_anchor, pose.translation());
  EXPECT_NEAR(s.latitude_deg, degrees(head.latitude), 0.6e-7);
  EXPECT_NEAR(s.longitude_deg, degrees(head.longitude), 0.6e-7);
  EXPECT_NEAR(s.heading_deg, 70, 0.011);
  EXPECT_NEAR(s.roll_deg, 0, 0.006);
  EXPECT_NEAR(s.pitch_deg, -pitch_deg, 0.006);  // the ship's axes are the head's
  ASSERT_EQ(s.beams, 65);
  const std::size_t beam = 64 - 44;  // port first
  ASSERT_EQ(s.flags[beam], 0);
  const double c = read.profile.at(0).second, range = 0.5 * c * s.arrays.at(4)[beam];
  EXPECT_GT(range, least);
  EXPECT_LT(range, most);
  const double across = std::sin(radians(24)), ahead = std::cos(radians(24)) * 0.5;
  const double down = std::cos(radians(24)) * std::sqrt(0.75);
  EXPECT_NEAR(s.arrays.at(2)[beam], -range * across, 2e-3);  // negative to port
  EXPECT_NEAR(s.arrays.at(3)[beam], range * ahead, 2e-3);
  EXPECT_NEAR(s.arrays.at(1)[beam], -pose.translation().z() + range * down, 2e-3);
  EXPECT_NEAR(s.arrays.at(5)[beam], degrees(std::acos(down)), 0.006);
  EXPECT_NEAR(s.arrays.at(18)[beam], degrees(std::atan2(ahead, -across)), 0.006);
  EXPECT_GT(s.arrays.at(6)[beam], 80);  // dB re 1 uPa
  EXPECT_GT(s.arrays.at(9)[beam], 2);
  EXPECT_GT(s.arrays.at(19)[beam], 0);
  // Beams beside it hear it by their side lobes, at its range.
  for (std::size_t b = 0; b < 65; ++b)
    if (s.flags[b] == 0) {
      EXPECT_NEAR(0.5 * c * s.arrays.at(4)[b], ball_range, ball_radius + 0.1) << b;
    }
}

TEST_F(ExportProducts, las_and_geotiff_have_it_at_its_place_in_utm) {
  succeed("export out --to las --anchor 54.1,7.9,90 --start-utc 2026-05-01T08:30:00Z -o ball.las -q");
  succeed("export out --to geotiff --anchor 54.1,7.9,90 --cell 0.25 -o ball.tif -q");
  const Eigen::Vector3d point = in_world(strongest_point("ball.las"));
  const double range = (point - pose.translation()).norm();
  EXPECT_GT(range, least);
  EXPECT_LT(range, most);
  const Eigen::Vector3d ball = pose * (range * unit_vector({radians(beam_deg), 0}));
  EXPECT_LT((point - ball).norm(), 1e-3);
  for (const decode::LasRow& row : decode::read_las(read_bytes("ball.las"))) {
    EXPECT_NEAR(row.time, 1777624200, 1e-6);
    EXPECT_EQ(row.classification, 40U);
    EXPECT_EQ(row.ping, 0U);
    EXPECT_NEAR(row.intensity, 100 * static_cast<double>(row.level_db), 0.51);
    EXPECT_GT(row.deviation, 0);
  }

  // Each sounding of the LAS file lies in a cell of the map whose mean height is near its own; the other cells are empty.
  const decode::GeotiffContent map = decode::read_geotiff(read_bytes("ball.tif"));
  EXPECT_EQ(map.epsg, 32632);
  ASSERT_EQ(map.bands.size(), 6U);
  float counted = 0;
  for (const float count : map.bands[2]) counted += count;
  const std::vector<decode::LasRow> rows = decode::read_las(read_bytes("ball.las"));
  EXPECT_EQ(static_cast<std::size_t>(counted), rows.size());
  std::vector<double> heights(map.bands[0].size(), 0);
  for (const decode::LasRow& row : rows) {
    const double column = std::floor((row.position[0] - map.west) / map.cell);
    const double line = std::floor((map.north - row.position[1]) / map.cell);
    ASSERT_TRUE(column >= 0 && column < static_cast<double>(map.columns) && line >= 0 &&
                line < static_cast<double>(map.rows));
    heights[static_cast<std::size_t>(line) * map.columns + static_cast<std::size_t>(column)] += row.position[2];
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double count = static_cast<double>(map.bands[2][i]);
    EXPECT_EQ(std::isnan(map.bands[0][i]), count == 0);
    if (count > 0) {
      EXPECT_NEAR(static_cast<double>(map.bands[0][i]), heights[i] / count, 1e-3);
    }
  }
}

TEST_F(ExportProducts, csv_has_a_row_for_each_sounding) {
  succeed("export out --to csv --anchor 54.1,7.9,90 --start-utc 2026-05-01T08:30:00Z -o ball.csv -q");
  succeed("export out --to las --anchor 54.1,7.9,90 -o ball.las -q");
  const std::vector<decode::LasRow> rows = decode::read_las(read_bytes("ball.las"));
  std::istringstream lines(read("ball.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "ping,time_s,beam,x_m,y_m,z_m,range_m,deviation_m,level_db,quality,method,reject,gsf_beam,"
            "latitude_deg,longitude_deg,easting_m,northing_m");
  // The page has a row for each extra column of LAS.
  const std::string page = file_bytes(INSONIFY_EXPORTS_PAGE);
  const auto expect_in_table = [&](const char* table, const std::string& column) {
    const std::size_t begin = page.find(table);
    ASSERT_NE(begin, page.npos) << table;
    EXPECT_THAT(page.substr(begin, page.find("\n\n", begin) - begin), HasSubstr("`" + column + "`"));
  };
  const std::string las_file = read_bytes("ball.las");
  for (const char* column : {"level_db", "deviation", "ping", "beam"}) {
    expect_in_table("| column of `las`", column);
    EXPECT_THAT(las_file, HasSubstr(std::string(column) + std::string(1, '\0')));
  }
  const auto table = rows_of(read("ball.csv"));
  ASSERT_EQ(table.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto number = [&](const char* name) { return std::stod(table[i].at(name)); };
    ASSERT_EQ(table[i].size(), 17U);
    const Eigen::Vector3d at(number("x_m"), number("y_m"), number("z_m"));
    const decode::LasRow& las = rows[i];
    EXPECT_LT((at - in_world({las.position[0], las.position[1], las.position[2]})).norm(), 1e-3);
    EXPECT_EQ(table[i].at("time_s"), "1777624200.000000");
    EXPECT_EQ(number("beam"), las.beam);
    EXPECT_NEAR(number("range_m"), (at - pose.translation()).norm(), 2e-4);
    EXPECT_NEAR(number("deviation_m"), static_cast<double>(las.deviation), 1e-5);
    EXPECT_NEAR(number("level_db"), static_cast<double>(las.level_db), 0.006);
    EXPECT_NEAR(number("quality"), std::log10(number("range_m") / number("deviation_m")), 0.01);
    const GeoPosition position = geo_from_world(ball_anchor, at);
    EXPECT_EQ(table[i].at("reject"), "0");
    EXPECT_NEAR(number("latitude_deg"), degrees(position.latitude), 2e-9);
    EXPECT_NEAR(number("longitude_deg"), degrees(position.longitude), 2e-9);
    EXPECT_NEAR(number("easting_m"), las.position[0], 2e-4);
    EXPECT_NEAR(number("northing_m"), las.position[1], 2e-4);
  }
  // Without a position on the globe the columns of the world remain.
  succeed("export out --to csv -o world.csv -q");
  EXPECT_THAT(read("world.csv"),
              testing::StartsWith("ping,time_s,beam,x_m,y_m,z_m,range_m,deviation_m,level_db,quality,"
                                  "method,reject,gsf_beam\n"));
}

// The head stands below the middle of the last row, port on the left.
TEST_F(ExportProducts, png_shows_it_to_port_at_its_range) {
  succeed("export out --to png -o pictures -q");
  const auto manifest = manifest_of("pictures");
  ASSERT_EQ(manifest["pings"].size(), 1U);
  const auto image = read_vtk<vtkPNGReader>(path("pictures/" + manifest["pings"][0]["fan"].get<std::string>()));
  const int* size = image->GetDimensions();
  const auto* pixel = static_cast<const unsigned char*>(image->GetScalarPointer());
  double x = 0, y = 0, sum = 0;
  const int brightest = *std::max_element(pixel, pixel + size[0] * size[1]);
  for (int row = 0; row < size[1]; ++row)
    for (int column = 0; column < size[0]; ++column)
      if (const double grey = pixel[row * size[0] + column]; grey > brightest - 10)
        x += grey * (row + 0.5), y += grey * (size[0] / 2 - column - 0.5), sum += grey;
  const double metre = manifest["metres_per_pixel"];
  EXPECT_NEAR(size[1] * metre, 14, 1e-9);
  EXPECT_NEAR(std::atan2(y, x), radians(beam_deg), radians(1.5));
  EXPECT_NEAR(std::hypot(x, y) / sum * metre, ball_range, ball_radius + 0.1);
  const auto& position = manifest["pings"][0]["world_from_head"];
  EXPECT_NEAR(position[3].get<double>(), pose.translation().x(), 1e-9);
  expect_refused("export out --to png -o pictures", 4, {"pictures", "--force"});
}

TEST_F(ExportProducts, soundings_can_be_looked_at) {
  succeed("image out --view soundings -o soundings.png -q");
  EXPECT_EQ(read("soundings.png").substr(1, 3), "PNG");
  succeed("ping ball.ply --sonar p900-45 --set sonar.beams=8 --pose=0,0,9,0,0,0 --range 1:3 --no-picture -q -o silent");
  expect_refused("image silent --view soundings -o none.png", 3, {"has no sounding of the bottom"});
}

TEST_F(ExportProducts, says_how_to_give_what_it_misses) {
  for (const char* to : {"gsf", "las", "geotiff"})
    expect_refused("export out --to " + std::string(to) + " -o product", 2,
                   {"--anchor LAT,LON[,HEADING]", "--utm ZONE"});
  expect_refused("export out --to las --anchor 54,8 -o packed.laz", 2,
                 {"packed.laz", "LAZ is not written", "ends in .las"});
  expect_refused("export out --to gsf --anchor 100,0 -o product", 2, {"--anchor", "latitude = 100"});
  expect_refused("export out --to gsf --utm 99N -o product", 2, {"--utm", "1 to 60"});
  expect_refused("export out --to mcap --start-utc yesterday -o product", 2, {"--start-utc 'yesterday'"});
  expect_refused("export none --to mcap -o product", 4, {"none"});
  write("cut.h5", read("out/cube.h5").substr(0, 5000));
  expect_refused("export cut.h5 --to mcap -o product", 3, {"cut.h5"});
}

// A world in UTM: soundings of LAS and GSF within 1 mm and 1e-7 degrees of the scene's own coordinates.
TEST(ExportUtm, keeps_the_coordinates_of_its_scene) {
  const Eigen::Vector3d ball(565432.125, 5995123.5, -15);
  const double radius = 0.02;
  class Tool : public ToolTest {
    void TestBody() override {}

   public:
    using ToolTest::expect_refused, ToolTest::path, ToolTest::read, ToolTest::succeed;
  } tool;
  SceneCloud scene;
  scene.origin = {565400, 5995100, 0};
  add_sphere(scene, ball, radius, 400);
  save_scene(tool.path("ball.ply"), scene);
  const Pose pose = head_above(ball);
  const Eigen::Vector3d at = pose.translation();
  std::ostringstream command;
  command.precision(16);
  command << "ping ball.ply --sonar r2sonic-2024 --mount=0,0,0,0,0,0 --set sonar.beams=65 --range 11:13 --split "
             "--no-picture -q --pose="
          << at.x() << ',' << at.y() << ',' << at.z() << ',' << yaw_deg << ',' << pitch_deg << ",0 -o out";
  tool.succeed(command.str());
  tool.succeed("export out --to csv -o ball.csv -q");
  tool.succeed("export out --to las --utm 32N -o ball.las -q");
  tool.succeed("export out --to gsf --utm 32N -o ball.gsf -q");

  // In LAS: on the axis of its beam at its range, to a millimetre; in all the same position.
  const std::vector<decode::LasRow> rows = decode::read_las(tool.read("ball.las"));
  const auto row = std::find_if(rows.begin(), rows.end(), [](const auto& r) { return r.beam == 44; });
  ASSERT_NE(row, rows.end());
  const Eigen::Vector3d point(row->position[0], row->position[1], row->position[2]);
  const double range = (point - at).norm();
  EXPECT_NEAR(range, ball_range, radius + 0.01);
  EXPECT_LT((point - pose * (range * unit_vector({radians(beam_deg), 0}))).norm(), 1e-3);
  EXPECT_LT((point - ball).norm(), radius + 0.01);
  // In GSF: the head's latitude and longitude, from which across and along lead to the sounding.
  const decode::GsfSwath s = decode::read_gsf(tool.read("ball.gsf")).swaths.at(0);
  const GeoPosition head = geo_position_of(UtmPosition{at.x(), at.y()}, {32, true});
  EXPECT_NEAR(s.latitude_deg, degrees(head.latitude), 0.6e-7);
  EXPECT_NEAR(s.longitude_deg, degrees(head.longitude), 0.6e-7);
  std::size_t beam = 0;
  for (std::size_t b = 0; b < s.flags.size(); ++b)
    if (s.flags[b] == 0 &&
        std::abs(s.arrays.at(5)[b] - degrees(std::acos(std::cos(radians(24)) * std::sqrt(0.75)))) < 0.01 &&
        s.arrays.at(2)[b] < 0)
      beam = b;
  EXPECT_NEAR(s.arrays.at(1)[beam], -point.z(), 1e-3);
  const Anchor here{degrees(head.latitude), degrees(head.longitude), s.heading_deg};
  const GeoPosition found = geo_from_world(here, {s.arrays.at(3)[beam], -s.arrays.at(2)[beam], 0});
  const GeoPosition expected = geo_position_of(UtmPosition{point.x(), point.y()}, {32, true});
  EXPECT_NEAR(degrees(found.latitude), degrees(expected.latitude), 1e-7);
  EXPECT_NEAR(degrees(found.longitude), degrees(expected.longitude), 1e-7);
  // Its PCD keeps its digits.
  const auto manifest = nlohmann::json::parse(tool.read("out/manifest.json"));
  EXPECT_EQ(manifest["returns_pcd_origin_m"], (std::vector<double>{565400, 5995100, 0}));
  EXPECT_THAT(tool.read("out/returns.pcd"), HasSubstr("VIEWPOINT 565400 5995100 0 1 0 0 0"));
}

// Two balls in one beam, above z = 0: two soundings of it, and depths below zero.
TEST_F(ExportProducts, gsf_has_several_soundings_of_a_beam_and_heights) {
  SceneCloud scene;
  const Pose high = head_above({0, 0, 30});
  for (const auto& [range, radius] :
       {std::pair(9.0, 0.03), std::pair(13.0, 0.4)})  // the far one shows round the near one
    add_sphere(scene, high * (range * unit_vector({0.1, 0})), radius, 3000);
  save_scene(path("two.ply"), scene);
  const Eigen::Vector3d at = high.translation();
  std::ostringstream command;
  command.precision(12);
  command << "ping two.ply --sonar r2sonic-2024 --mount=0,0,0,0,0,0 --set sonar.beams=65 --range 8:14 --noise "
             "--no-picture -q --force --pose="
          << at.x() << ',' << at.y() << ',' << at.z() << ',' << yaw_deg << ',' << pitch_deg << ",0 -o two";
  succeed(command.str());
  succeed("export two --to gsf --anchor 54.1,7.9 -o one.gsf -q");
  succeed("export two --to gsf --anchor 54.1,7.9 --per-beam 3 -o many.gsf -q");
  const decode::GsfSwath one = decode::read_gsf(read_bytes("one.gsf")).swaths.at(0);
  const decode::GsfSwath many = decode::read_gsf(read_bytes("many.gsf")).swaths.at(0);
  EXPECT_EQ(one.beams, 65);
  EXPECT_GT(many.beams, 65);
  std::map<double, std::vector<double>> depths;  // by angle and azimuth of the beam
  for (std::size_t b = 0; b < many.flags.size(); ++b)
    if (many.flags[b] == 0) depths[1000 * many.arrays.at(5)[b] + many.arrays.at(18)[b]].push_back(many.arrays.at(1)[b]);
  bool both = false;
  for (const auto& [beam, of_beam] : depths) {
    for (const double depth : of_beam) EXPECT_LT(depth, -20);
    // Ranges from 9 m to the front of the far ball.
    const double apart =
        of_beam.size() == 2 ? std::abs(of_beam[0] - of_beam[1]) / (std::cos(0.1) * std::sqrt(0.75)) : 0;
    both |= apart > 3.5 && apart < 4.1;
  }
  EXPECT_TRUE(both);
}
