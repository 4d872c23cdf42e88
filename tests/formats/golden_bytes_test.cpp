// SPDX-License-Identifier: BSD-3-Clause
// Files byte for byte as they stand in tests/data/golden/products, where the decoders of these tests and
// other programs have read them (README.md there): a change of a writer is seen, whatever the decoders overlook.
#include "formats/geotiff_file.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/gsf_file.hpp"
#include "formats/las_decoder.hpp"
#include "formats/las_file.hpp"
#include "formats/mcap_file.hpp"
#include "formats/ros_decoder.hpp"
#include "formats/ros_messages.hpp"
#include "formats/tiff_decoder.hpp"
#include "formats/xtf_decoder.hpp"
#include "formats/xtf_file.hpp"
#include "support/test.hpp"

namespace {

/// Expects the bytes of the golden file of this name. To make it anew, delete it and run this test twice, after the
/// decoders and another program have read what it writes.
void expect_golden(const std::string& written, const std::string& name) {
  const std::string golden = std::string(INSONIFY_GOLDEN_PRODUCTS) + "/" + name, bytes = file_bytes(written);
  if (!std::filesystem::exists(golden)) {
    std::filesystem::copy_file(written, golden);
    FAIL() << golden << " was missing and has been written: read it with another program, then commit it";
  }
  const std::string expected = file_bytes(golden);
  const auto differ = std::mismatch(bytes.begin(), bytes.end(), expected.begin(), expected.end()).first;
  EXPECT_TRUE(bytes == expected) << name << " differs from byte " << differ - bytes.begin() << " on";
}

/// Returns a ball to port, ahead of the head and above the bed: two beams, and one without an echo.
GsfPing golden_swath(double time) {
  GsfPing ping;
  ping.time = time, ping.position = {radians(54.1), radians(7.9), 0};
  ping.heading = radians(70), ping.course = radians(71.5), ping.speed = 1.5, ping.number = 12;
  ping.pitch = radians(2), ping.roll = radians(-3), ping.head_depth = 1.5, ping.tide = -0.25;
  ping.surface_sound_speed = 1490.2, ping.range = 50;
  ping.beam_width_along = radians(1), ping.beam_width_across = radians(0.5);
  ping.beams = {{true, 15, -4.0625, 3.5, 0.0212, radians(24.5), radians(140), 121.4, 3.2, 0.0125, 0.0075, true},
                {},
                {true, -2.5, 1.5, -0.25, 0.0075, radians(10), radians(-12.5), 99.6, 2.5, 0.05, 0.025, false}};
  return ping;
}

Ping golden_ping() {
  Ping ping;
  ping.number = 12, ping.time = 3;
  ping.fan = make_fan(3, radians(60), radians(20), radians(15));
  ping.gate = {1, 2, 0.25};
  ping.world_from_head.translation() = Eigen::Vector3d(1, 2, -3);
  ping.pressure = ComplexGridF::Zero(3, 4);
  ping.pressure(2, 1) = 1;
  return ping;
}

}  // namespace

TEST(GoldenBytes, of_gsf) {
  const std::string path = own_path("swaths.gsf");
  GsfSurvey survey;
  survey.profile = {{0, 25}, {1490.25, 1481}};
  survey.position = {radians(54.1), radians(7.9), 0}, survey.time = 1777624200;
  survey.comment = "sonar seabat-t50, simulated by insonify 1";
  survey.history_command = "insonify export --to gsf", survey.history_comment = "soundings found in each ping";
  survey.processing.mounting = GsfMounting{{0.5, 0.25, 1}, 0, radians(1.5), 0};
  survey.position_deviation = 0.5;
  GsfFile file(path, survey);
  for (const double time : {1777624200.25, 1777624200.75}) file.add(golden_swath(time));
  file.finish();
  EXPECT_EQ(decode::read_gsf(file_bytes(path)).swaths.size(), 2U);
  expect_golden(path, "swaths.gsf");
}

TEST(GoldenBytes, of_las) {
  const std::string path = own_path("soundings.las");
  LasFile file(path, UtmZone{32, true}, {565400, 5995100, 0});
  file.add({{565432.125, 5995123.5, -15.0625}, 1777624200.25, 121.5F, 0.0125F, 12, 44});
  file.add({{565401, 5995099.75, 2.5}, 1777624200.75, 99.25F, 0.05F, 13, 0});
  file.finish();
  EXPECT_EQ(decode::read_las(file_bytes(path)).size(), 2U);
  expect_golden(path, "soundings.las");
}

TEST(GoldenBytes, of_mcap) {
  const std::string path = own_path("log.mcap");
  const Ping ping = golden_ping();
  McapFile file(path);
  const auto add = [&](const char* topic, const RosType& type) {
    return file.add_topic(topic, type.name, type.text, {{"key", "value"}});
  };
  const auto image = add("/sonar/image", projected_sonar_image_type()), fan = add("/sonar/fan", image_type());
  const auto points = add("/sonar/points", point_cloud_type()), tf = add("/tf", transforms_type());
  constexpr std::uint64_t time = 1777624200250000000;
  file.add(image, time, projected_sonar_image(ping, time, 4e5, 1490.25, {0, 0}, {false, {40, 120}, 1}));
  file.add(fan, time, fan_image(ping, time, {0, 0}, {40, 120}, 8));
  file.add(points, time, point_cloud(decode::soundings_at({{1, 2, -15}}, {121.5F}), {0, 0, 0}, time));
  file.add(tf, time, head_transform(ping.world_from_head, {0, 0, 0}, time));
  file.finish();
  EXPECT_EQ(decode::read_mcap(file_bytes(path)).messages.size(), 4U);
  expect_golden(path, "log.mcap");
}

TEST(GoldenBytes, of_geotiff) {
  const std::string path = own_path("bed.tif");
  std::vector<GeoBand> bands(2);
  bands[0].name = "height", bands[0].unit = "m", bands[1].name = "soundings";
  bands[0].values.resize(2, 3), bands[1].values.resize(2, 3);
  bands[0].values << -20, -21, std::numeric_limits<float>::quiet_NaN(), -18, -17.5F, 2.25F;
  bands[1].values << 1, 2, 0, 4, 5, 6;
  write_geotiff(path, bands, {32632, 565400, 5995100, 0.5});
  EXPECT_EQ(decode::read_geotiff(file_bytes(path)).bands.size(), 2U);
  expect_golden(path, "bed.tif");
}

TEST(GoldenBytes, of_xtf) {
  const std::string path = own_path("line.xtf");
  XtfHeader header;
  header.program = "insonify", header.version = "223", header.sonar = "klein-3000", header.note = "simulated";
  header.channels = {{XtfSide::port, XtfSamples::integer_16, "port", 5e5, radians(0.25), radians(40), radians(15)},
                     {XtfSide::starboard, XtfSamples::ieee_float, "starboard", 5e5, radians(0.25), radians(40), 0}};
  header.notes = {"amplitude [Pa] = value * 0.5"};
  XtfFile file(path, header);
  for (const double time : {1777624200.25, 1777624200.75}) {
    XtfPing ping;
    ping.number = 12, ping.time = time, ping.sound_speed = 1490.5, ping.period = 0.5;
    ping.ship = {7.90625, 54.125}, ping.sensor = {7.9062500625, 54.1250000625};
    ping.ship_heading = radians(70), ping.heading = radians(71.5), ping.pitch = radians(2), ping.roll = radians(-3);
    ping.speed = 1.5, ping.depth = 1.5, ping.altitude = 4.25;
    ping.traces = {{0, 0, 30, 5e5, true, {0, 1, 2, 65535}}, {1, 0.5, 30, 5e5, true, {0, 0.25F, 1e6F}}};
    file.add(ping);
  }
  file.finish();
  EXPECT_EQ(decode::read_xtf_file(file_bytes(path)).pings.size(), 2U);
  expect_golden(path, "line.xtf");
}
