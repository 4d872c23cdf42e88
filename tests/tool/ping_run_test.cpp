// One ping from the command line: what it writes, and that the same words give the same bytes.
#include <nlohmann/json.hpp>
#include <pcl/io/pcd_io.h>

#include "returns/compare.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace {

const std::string harbour_head = " --sonar p900-45 --set sonar.beams=32 --pose=0,0,-3,0,10,0 --range 2:14";

class PingRun : public ToolTest {
 protected:
  void SetUp() override { have("harbour.ply", "make-scene harbour --points 15000"); }
  ComplexGrid image(const std::string& run) const {
    return read_cube(path(run + "/cube.h5")).pings.at(0).pressure.cast<std::complex<double>>();
  }
};

/// A PLY reader of the test's own: columns of a little-endian binary file by name.
std::map<std::string, std::vector<double>> read_ply_columns(const std::string& bytes) {
  std::istringstream header(bytes);
  std::vector<std::pair<std::string, std::string>> properties;
  std::size_t count = 0;
  for (std::string line; std::getline(header, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element" && second == "vertex") count = std::stoul(third);
    if (first == "property") properties.emplace_back(second, third);
    if (first == "format") {
      EXPECT_EQ(second, "binary_little_endian");
    }
  }
  std::map<std::string, std::vector<double>> columns;
  const char* at = bytes.data() + header.tellg();
  const auto take = [&](auto value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return static_cast<double>(value);
  };
  for (std::size_t i = 0; i < count; ++i)
    for (const auto& [type, name] : properties)
      columns[name].push_back(type == "double" ? take(0.0) : type == "float" ? take(0.0F) : take(std::uint32_t{0}));
  EXPECT_EQ(at, bytes.data() + bytes.size());
  return columns;
}

}  // namespace

TEST_F(PingRun, writes_everything_and_says_what_it_did) {
  succeed("ping harbour.ply -o out" + harbour_head);
  for (const char* file : {"cube.h5", "returns.pcd", "returns.ply", "fan.png", "run.toml", "manifest.json"})
    EXPECT_TRUE(std::filesystem::exists(path(std::string("out/") + file))) << file;
  const auto manifest = nlohmann::json::parse(read("out/manifest.json"));
  for (const char* stage : {"load", "sampling", "acoustics", "synthesis", "output"})
    EXPECT_GT(manifest["seconds"][stage].get<double>(), 0) << stage;
  EXPECT_GT(manifest["sampling"]["scatterers"].get<int>(), 1000);
  for (const auto& note : manifest["notes"])
    EXPECT_EQ(note.get<std::string>().find("the ping is silent"), std::string::npos) << note;
  EXPECT_GT(manifest["peak_memory_mib"].get<double>(), 1);
  EXPECT_EQ(manifest["seed"], 1);
  // Every line of run.toml's [sonar] makes a sonar file again.
  EXPECT_THAT(read("out/run.toml"), HasSubstr("[sonar]"));
}

TEST_F(PingRun, same_seed_same_bytes_for_one_and_two_threads) {
  succeed("ping harbour.ply -j1 -o one --no-picture" + harbour_head);
  succeed("ping harbour.ply -j2 -o two --no-picture" + harbour_head);
  EXPECT_EQ(read("one/cube.h5"), read("two/cube.h5"));
  EXPECT_EQ(read("one/returns.pcd"), read("two/returns.pcd"));
  EXPECT_EQ(read("one/returns.ply"), read("two/returns.ply"));
}

TEST_F(PingRun, another_seed_gives_other_speckle_of_the_same_level) {
  have("plane.ply", "make-scene plane --points 15000 --size 18,18");
  const std::string over_plane = " --sonar p900-45 --set sonar.beams=64 --pose=0,0,3,0,15,0 --range 4:12 --no-picture";
  succeed("ping plane.ply --seed 1 -o one" + over_plane);
  succeed("ping plane.ply --seed 2 -o two" + over_plane);
  ComplexGrid a = image("one"), b = image("two");
  for (Eigen::Index n = 0; n < a.cols(); ++n) {  // near and far cells weigh the same: p falls about as r^-2.5
    const double r = 4 + (static_cast<double>(n) + 0.5) * 8 / static_cast<double>(a.cols());
    a.col(n) *= std::pow(r, 2.5), b.col(n) *= std::pow(r, 2.5);
  }
  const ImageDifference d = compare_images(a, b);
  EXPECT_LT(d.correlation, 0.05);
  EXPECT_NEAR(d.mean_level_db, 0, 0.4);
}

TEST_F(PingRun, returned_points_open_elsewhere_and_lie_on_the_scene) {
  have("plane.ply", "make-scene plane --points 15000 --size 18,18");
  succeed(
      "ping plane.ply --sonar p900-45 --set sonar.beams=64 --pose=0,0,3,0,15,0 --range 4:12 "
      "--false-alarm-rate 1 -o out --no-picture -q");
  const auto columns = read_ply_columns(read("out/returns.ply"));
  for (const char* name :
       {"x", "y", "z", "scalar_level_db", "scalar_range", "scalar_azimuth", "scalar_elevation", "scalar_ping",
        "scalar_beam", "scalar_bin", "scalar_true_elevation", "scalar_true_surfel", "scalar_true_material"})
    ASSERT_TRUE(columns.count(name)) << name;
  const auto& z = columns.at("z");
  ASSERT_GT(z.size(), 1000U);
  std::vector<double> off;
  const auto& surfel = columns.at("scalar_true_surfel");
  for (std::size_t i = 0; i < z.size(); ++i)
    if (surfel[i] != 4294967295.0) off.push_back(std::abs(z[i]));  // the others are side lobes
  ASSERT_GT(off.size(), 1000U);
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  const double bin = read_cube(path("out/cube.h5")).pings[0].gate.bin_size;
  EXPECT_LT(off[off.size() / 2], bin);
  EXPECT_LT(*std::max_element(off.begin(), off.end()), 3 * bin);
  // The PCD, read through PCL, holds the same points.
  pcl::PCLPointCloud2 pcd;
  ASSERT_EQ(pcl::io::loadPCDFile(path("out/returns.pcd"), pcd), 0);
  EXPECT_EQ(pcd.width * pcd.height, z.size());
}

TEST_F(PingRun, notes_a_head_below_the_ground) {
  have("plane.ply", "make-scene plane --points 15000 --size 18,18");
  const std::string head = " --sonar p900-45 --set sonar.beams=8 --range 2:12 --no-picture -q";
  const auto notes = [&](const std::string& run) {
    return nlohmann::json::parse(read(run + "/manifest.json"))["notes"].dump();
  };
  succeed("ping plane.ply --pose=0,0,-2,0,-15,0 -o below" + head);
  EXPECT_THAT(notes("below"), HasSubstr("face away from the head and give no echo: is it below the ground"));
  succeed("ping plane.ply --pose=0,0,2,0,15,0 -o above" + head);
  EXPECT_THAT(notes("above"), testing::Not(HasSubstr("face away")));
}

TEST_F(PingRun, moving_scene_and_head_by_a_million_metres_changes_nothing) {
  // Coordinates in steps of 1/64 m are exact in double even at 10^6 m.
  std::string near = "x y z\n", far = "x y z\n";
  for (int i = 0; i < 100; ++i)
    for (int j = -40; j < 40; ++j) {
      const double x = i / 16.0, y = j / 16.0, z = ((i * 7 + j * 3) % 5) / 64.0;
      std::ostringstream a, b;
      a.precision(17), b.precision(17);
      a << x << ' ' << y << ' ' << z << '\n';
      b << x + 1e6 << ' ' << y - 2e6 << ' ' << z + 500 << '\n';
      near += a.str(), far += b.str();
    }
  write("near.xyz", near);
  write("far.xyz", far);
  const std::string sonar = " --sonar p900-45 --set sonar.beams=16 --range 2:7 --no-picture -q";
  succeed("ping near.xyz --viewpoint=0,0,10 --pose=0,0,2.5,0,15,0 -o near" + sonar);
  succeed("ping far.xyz --viewpoint=1000000,-2000000,510 --pose=1000000,-2000000,502.5,0,15,0 -o far" + sonar);
  EXPECT_LT(compare_images(image("far"), image("near")).relative_l2, 1e-9);
}

TEST_F(PingRun, a_view_of_nothing_is_silent_and_says_so) {
  const ToolResult result = run("ping harbour.ply --sonar p900-45 --pose=30,0,3,0,-90,0 --range 2:25 -o out");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("the ping is silent"));
  EXPECT_EQ(image("out").abs().maxCoeff(), 0);
  EXPECT_TRUE(std::filesystem::exists(path("out/fan.png")));
}

// Nothing in view: what is left is thermal noise, a beam's directivity below that of one element.
TEST_F(PingRun, noise_fills_a_silent_view_at_the_noise_floor) {
  succeed("ping harbour.ply --sonar p900-45 --pose=30,0,3,0,-90,0 --range 2:25 --noise --no-picture -q -o out");
  const auto manifest = nlohmann::json::parse(read("out/manifest.json"));
  const Ping ping = read_cube(path("out/cube.h5")).pings.at(0);
  EXPECT_NEAR(mean_level_db(ping, 2, 25), manifest["sampling"]["noise_floor_db"].get<double>(), 0.4);
}

TEST_F(PingRun, water_outside_the_formulas_is_computed_and_noted) {
  const ToolResult result = run("ping harbour.ply --set water.temperature_c=45 --no-picture -o out" + harbour_head);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("45")) << result.err;
  EXPECT_THAT(result.err, HasSubstr("extrapolation")) << result.err;
}

TEST_F(PingRun, settings_may_stand_before_the_scene) {
  succeed(
      "ping --set sonar.beams=8 --set water.ph=7.9 harbour.ply --sonar p900-45 --pose 0,0,-3,0,10,0 --range 2:9 "
      "--no-picture -q -o out");
  EXPECT_EQ(read_cube(path("out/cube.h5")).pings.at(0).fan.beams(), 8U);
}

TEST_F(PingRun, draws_each_view) {
  succeed("ping harbour.ply -o out --no-picture -q" + harbour_head);
  for (const std::string view : {"fan", "rect", "ascan"}) {
    succeed("image out --view " + view + " -o " + view + ".png --size 400x300 -q");
    EXPECT_EQ(read(view + ".png").substr(1, 3), "PNG");
  }
}

TEST_F(PingRun, prepared_scene_gives_the_same_ping) {
  succeed("prepare harbour.ply -o again.ply -q");
  succeed("ping harbour.ply -o one --no-picture -q" + harbour_head);
  succeed("ping again.ply -o two --no-picture -q" + harbour_head);
  EXPECT_EQ(compare_images(image("one"), image("two")).relative_l2, 0);
}

TEST_F(PingRun, info_tells_machines_what_it_tells_people) {
  const auto cloud = nlohmann::json::parse(succeed("info harbour.ply --json"));
  EXPECT_NEAR(cloud["points"].get<double>(), 15000, 300);
  EXPECT_TRUE(cloud["normals"].get<bool>());
  EXPECT_LE(cloud["bounds"]["max"][2].get<double>(), 1e-3);
  EXPECT_THAT(succeed("info harbour.ply"), HasSubstr("bounds"));
  write("grid.xyz", "451000.25 5411030.5 -20\n451000.75 5411030.5 -20\n451000.25 5411031.0 -20\n");
  EXPECT_THAT(succeed("info grid.xyz"), HasSubstr("y 5411030.50..5411031.00"));
  succeed("ping harbour.ply -o out --no-picture -q" + harbour_head);
  EXPECT_EQ(nlohmann::json::parse(succeed("info out --json"))["beams"], 32);
}

TEST_F(PingRun, sonars_show_every_number_with_its_source) {
  const auto all = nlohmann::json::parse(succeed("sonars --json"));
  EXPECT_GT(all.size(), 20U);
  for (const auto& sonar : all)
    for (const auto& number : sonar["numbers"]) {
      EXPECT_FALSE(number["status"].get<std::string>().empty()) << sonar["name"] << " " << number["key"];
      EXPECT_FALSE(number["source"].get<std::string>().empty()) << sonar["name"] << " " << number["key"];
    }
  EXPECT_THAT(succeed("sonars oculus-m750d"), HasSubstr("centre_frequency_hz"));
}
