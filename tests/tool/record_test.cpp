// SPDX-License-Identifier: BSD-3-Clause
// Recordings of real sonars through the whole tool: what info says, pictures, the viewer, and comparisons.
#include "support/test.hpp"
#include "tool/run/record_file.hpp"
#include "tool/tool_runner.hpp"
#include "view/grey_file.hpp"

using namespace insonify::tool;

namespace {

const std::string side_scan = INSONIFY_RECORDS "/sidescan_scotsman.xtf";
const std::string oculus = INSONIFY_RECORDS "/oculus_three_pings_8bit.raw";
const std::string aris = INSONIFY_RECORDS "/sample.aris";

class RecordRun : public ToolTest {
 protected:
  /// A port side of the record's range and bins over a level bed, 40 pings.
  void have_line() const {
    write("bed.obj", "v -12 -32 -4\nv 12 -32 -4\nv 12 32 -4\nv -12 32 -4\nf 1 2 3\nf 1 3 4\n");
    write("line.toml",
          "schema = 1\n[survey]\nscene = \"bed.obj\"\n[trajectory]\nwaypoints_m = [[-2, 0, 0], [2, 0, 0]]\nspeed_m_s = "
          "2\n"
          "[[head]]\nname = \"port\"\nsonar = \"starfish-450\"\nrange = \"1:29.98\"\nevery_m = 0.1\n"
          "set = [\"sonar.range_resolution_m=0.06\", \"sonar.bandwidth_hz=12500\"]\n");
    have("line", "survey line.toml -q");
    succeed("merge line -q");
  }
};

}  // namespace

TEST_F(RecordRun, info_says_what_recordings_are) {
  const nlohmann::json s = json_of("info " + side_scan);
  EXPECT_EQ(s["format"], "XTF by SEASCAN");
  EXPECT_EQ(s["pings"], 115);
  EXPECT_EQ(s["beams"], 2);
  EXPECT_EQ(s["bins"], 1024);
  EXPECT_NEAR(s["max_range_m"].get<double>(), 29.98, 0.005);
  EXPECT_EQ(s["centre_frequency_hz"], 600000);
  EXPECT_EQ(s["sound_speed"], 1500);
  EXPECT_EQ(s["channels"], (std::vector<std::string>{"PORT", "STARBOARD"}));
  EXPECT_EQ(s["first_utc"].get<std::string>().substr(0, 10), "2013-09-10");
  EXPECT_GT(s["track_length_m"].get<double>(), 10);
  EXPECT_LT(s["track_length_m"].get<double>(), 20);  // 12 s at 1 m/s
  const nlohmann::json o = json_of("info " + oculus);
  EXPECT_EQ(o["pings"], 3);
  EXPECT_EQ(o["beams"], 256);
  EXPECT_EQ(o["bins"], 703);
  EXPECT_NEAR(o["sound_speed"].get<double>(), 1490.66, 0.005);
  EXPECT_NEAR(o["field_of_view_deg"].get<double>(), 60, 1);
  const nlohmann::json a = json_of("info " + aris);
  EXPECT_EQ(a["format"], "ARIS 1200, telephoto lens");
  EXPECT_EQ(a["pings"], 2);
  EXPECT_EQ(a["bins"], 2000);
}

// The picture of a side-scan has both sides; of a record no gain is given back unless it is asked for.
TEST_F(RecordRun, pictures_are_of_levels_as_recorded) {
  const auto size_of = [&](const std::string& file) { return load_grey_png(path(file)).value.size(); };
  succeed("image " + side_scan + " --view waterfall -o both.png -q");
  succeed("image " + side_scan + " --view waterfall --beam 0 -o port.png -q");
  EXPECT_FALSE(read("both.png") == read("port.png"));
  succeed("image " + oculus + " -o fan.png -q");
  succeed("image " + oculus + " --raw -o raw.png -q");
  succeed("image " + oculus + " --tvg 40 -o tvg.png -q");
  EXPECT_TRUE(read("fan.png") == read("raw.png"));
  EXPECT_FALSE(read("fan.png") == read("tvg.png"));
  succeed("image " + aris + " --view grey --ping 1 -o grey.png -q");
  EXPECT_EQ(size_of("grey.png"), 48 * 2000);
  expect_refused("image " + side_scan + " --layer noise -o x.png", 2, {"is a recording, which has none"});
  expect_refused("image " + side_scan + " -o x.png", 2, {"--view fan shows beams by bearing", "take --view waterfall"});
  for (const std::string& file : {side_scan, oculus, aris})
    expect_refused("image " + file + " --view spectrum -o x.png", 2,
                   {"--view spectrum shows frequencies, which the levels of a recording", "take --view ascan"});
  expect_refused("image " + oculus + " --ping 3 -o x.png", 2, {"--ping = 3, must be below 3"});
}

TEST_F(RecordRun, export_says_at_once_what_it_cannot_do_and_what_others_can) {
  for (const std::string& file : {side_scan, oculus, aris})
    for (const char* to : {"gsf", "csv", "xtf", "vtk", "png"})
      expect_refused("export " + file + " --to " + to + " -o x", 3,
                     {"is a recording of a sonar", "insonify image", "--view waterfall", "insonify compare"});
  succeed("image " + side_scan + " --view waterfall -o proposed.png -q");
}

TEST_F(RecordRun, the_viewer_shows_them) {
  for (const std::string& target : {side_scan + " --head STARBOARD", oculus + " --ping 2", aris})
    EXPECT_EQ(std::system(
                  (INSONIFY_VIEWER " " + target + " --screenshot " + path("v.png") + " --force -q >/dev/null").c_str()),
              0)
        << target;
  EXPECT_NE(std::system(
                (INSONIFY_VIEWER " " + side_scan + " --head BOW --screenshot " + path("v.png") + " --force 2>/dev/null")
                    .c_str()),
            0);
}

TEST_F(RecordRun, levels_are_those_of_the_samples) {
  const Record r = read_record(side_scan);
  ASSERT_EQ(r.cube.pings.size(), 115U);
  EXPECT_EQ(r.unit, "dB re full scale");
  const Grid<float> port = levels_of_beam(r.cube, 0);
  // The first sample of the first ping, saturated at 32767 of 65535, and its last but one from afar.
  const std::string bytes = file_bytes(side_scan);
  const auto sample = [&](std::size_t n) {  // of port, stored farthest first
    const std::size_t at = 1024 + 256 + 64 + 2 * (1023 - n);
    return static_cast<unsigned char>(bytes[at]) + 256 * static_cast<unsigned char>(bytes[at + 1]);
  };
  for (const std::size_t n : {std::size_t{0}, std::size_t{500}, std::size_t{1022}})
    EXPECT_NEAR(static_cast<double>(port(0, static_cast<Eigen::Index>(n))), 20 * std::log10(sample(n) / 65535.0), 1e-4);
  EXPECT_NEAR(r.cube.pings[0].world_from_head.translation().head<2>().norm(), 0, 1e-6);
}

// A recording whose range changes is brought to the finest bins.
TEST_F(RecordRun, side_scans_of_several_ranges_are_one_image) {
  std::string bytes = file_bytes(side_scan).substr(0, 1024 + 2 * 4480);
  const float twice = 59.966999F;
  for (const int channel : {0, 1}) std::memcpy(bytes.data() + 1024 + 4480 + 256 + channel * (64 + 2048) + 4, &twice, 4);
  write("two.xtf", bytes);
  const Record r = read_record(path("two.xtf"));
  EXPECT_EQ(r.cube.pings[0].gate.bins(), 2048U);
  const Grid<float> level = levels_of_beam(r.cube, 1);
  EXPECT_EQ(level(0, 1500), static_cast<float>(silence_db));
  EXPECT_EQ(level(1, 1500), level(1, 1501));
  const float far = 5000;
  std::memcpy(bytes.data() + 1024 + 4480 + 256 + 4, &far, 4);
  write("far.xtf", bytes);
  expect_refused("info far.xtf", 3,
                 {"far.xtf: its ranges or channels differ too much to be one image", "split the recording"});
}

TEST_F(RecordRun, compares_a_side_scan_with_a_line) {
  have_line();
  const nlohmann::json r = json_of("compare line/port " + side_scan + " --channel 0 -o out");
  EXPECT_EQ(r["a"]["beams"], 40);  // as many pings as both have
  EXPECT_EQ(r["b"]["beams"], 40);
  EXPECT_EQ(r["b"]["bins"], 1024);
  EXPECT_EQ(r["b"]["kind"], "XTF by SEASCAN, PORT");
  ASSERT_EQ(r["bands"].size(), 5U);
  EXPECT_NEAR(r["bands"][4]["to_m"].get<double>(), 29.98, 0.01);
  EXPECT_NEAR(r["bands"][3]["a"]["amplitude_contrast"].get<double>(), 0.52, 0.06);  // one look
  EXPECT_NEAR(r["side_scan"]["a"]["first_return_m"].get<double>(), 4, 0.2);
  EXPECT_LT(r["side_scan"]["a"]["shadow_share"].get<double>(), 0.01);
  EXPECT_NEAR(r["side_scan"]["b"]["first_return_less_altitude_m"].get<double>(), 0, 1.5);
  const std::string table = succeed("compare line/port " + side_scan);
  EXPECT_THAT(table, HasSubstr("first return - altitude [m]"));
  EXPECT_THAT(table, HasSubstr("range [m], A and B"));
  expect_refused("compare line/port " + side_scan + " --channel 2", 2, {"--channel = 2, must be below 2"});
  succeed("ping bed.obj --sonar p900-45 --set sonar.beams=8 --pose=0,0,0,0,30,0 --range 2:9 --no-picture -q -o fan");
  expect_refused("compare fan " + side_scan, 3,
                 {"fan", "p900-45 has 8 beams; the recording of a side-scan is compared with a run of one"});
}

TEST_F(RecordRun, compares_a_fan_with_an_oculus) {
  write("bed.obj", "v -9 -9 -1\nv 9 -9 -1\nv 9 9 -1\nv -9 9 -1\nf 1 2 3\nf 1 3 4\n");
  succeed(
      "ping bed.obj --sonar oculus-m1200d-hf --set sonar.beams=64 --pose=0,0,0,0,40,0 --range 0.3:2 --no-picture -q -o "
      "fan");
  const nlohmann::json r = json_of("compare fan " + oculus + " --frame 2");
  EXPECT_EQ(r["b"]["beams"], 256);
  EXPECT_EQ(r["b"]["kind"], "Oculus of 8 bits");
  EXPECT_TRUE(r["side_scan"].is_null());
  EXPECT_EQ(r["bands"].size(), 5U);
  expect_refused("compare fan " + oculus + " --frame 3", 2, {"ping 3, must be below the number of pings, 3"});
}

TEST_F(RecordRun, refuses_what_is_no_recording) {
  write("x.xtf", "rubbish");
  expect_refused("info x.xtf", 3, {"x.xtf: does not begin with 123, so it is no XTF recording"});
  expect_refused("image x.xtf --view waterfall -o x.png", 3, {"x.xtf"});
  write("x.raw", "rubbish of sixteen bytes and more");
  expect_refused("info x.raw", 3, {"x.raw: the message at byte 0 does not begin with the mark of Oculus"});
  expect_refused("compare x.xtf x.raw", 3, {"x.xtf"});
}
