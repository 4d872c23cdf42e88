// SPDX-License-Identifier: BSD-3-Clause
// Runs what `info` proposes for a scene as it stands, and judges the soundings against the surface that the scene was
// made from, a function of x and y.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/random.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "tool/tool_runner.hpp"

namespace {

/// A river bed: dunes of 7 m, ripples on them, and a bank that rises to port, with boulders of up to 1.2 m across.
class RiverBed {
 public:
  explicit RiverBed(Eigen::Vector3d at) : at_(std::move(at)) {
    for (std::uint64_t k = 0; k < 40; ++k) {
      const auto position = random_complex_normal(11, RandomStage::noise, {k, 0, 0}),
                 size = random_complex_normal(11, RandomStage::noise, {k, 1, 0});
      stones_.push_back(
          {length * (0.5 + 0.3 * position.real()), 4.5 + 0.8 * position.imag(), 0.2 + 0.2 * std::abs(size)});
    }
  }
  static constexpr double length = 20, half_width = 6;

  /// Returns the height of the surface [m] at x and y [m], all in the coordinates of the file.
  double height(double x, double y) const {
    const double u = x - at_.x(), v = y - at_.y();
    double z = 0.35 * std::sin(2 * pi * u / 7 + 0.4 * std::sin(v / 3)) + 0.03 * std::sin(2 * pi * u / 0.9);
    z += 0.5 * std::pow(std::max(0.0, v - 2), 1.3);
    for (const Eigen::Vector3d& s : stones_) {
      const double d = std::hypot(u - s.x(), v - s.y()) / s.z();
      if (d < 1) z += 0.8 * s.z() * std::pow(1 - d * d, 2);
    }
    return at_.z() + z;
  }
  /// Distance of a position from the surface [m]: over a grid of 2 cm about it, within 0.7 m.
  double distance(const Eigen::Vector3d& p) const {
    double least = std::abs(p.z() - height(p.x(), p.y()));
    const int reach = static_cast<int>(std::ceil(std::min(0.7, least) / 0.02));
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) {
        const double x = p.x() + 0.02 * i, y = p.y() + 0.02 * j;
        if (is_in(x, y)) least = std::min(least, (Eigen::Vector3d(x, y, height(x, y)) - p).norm());
      }
    return least;
  }
  /// Places 8 cm apart, each off its grid by some centimetres.
  std::vector<Eigen::Vector3d> points() const {
    std::vector<Eigen::Vector3d> all;
    for (int i = 0; 0.08 * i < length; ++i)
      for (int j = 0; 0.08 * j < 2 * half_width; ++j) {
        const auto off = random_complex_normal(12, RandomStage::noise,
                                               {static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j), 0});
        const double x = at_.x() + std::clamp(0.08 * i + 0.02 * off.real(), 0.0, length);
        const double y = at_.y() - half_width + std::clamp(0.08 * j + 0.02 * off.imag(), 0.0, 2 * half_width);
        all.emplace_back(x, y, height(x, y));
      }
    return all;
  }

 private:
  bool is_in(double x, double y) const {
    return x >= at_.x() && x <= at_.x() + length && std::abs(y - at_.y()) <= half_width;
  }
  Eigen::Vector3d at_;
  std::vector<Eigen::Vector3d> stones_;  ///< x, y, radius
};

std::string as_text(const RiverBed& bed) {
  std::string text;
  for (const Eigen::Vector3d& p : bed.points()) text += fmt::format("{:.3f} {:.3f} {:.3f}\n", p.x(), p.y(), p.z());
  return text;
}

/// Triangles of a grid of 10 cm.
std::string as_mesh(const RiverBed& bed, const Eigen::Vector3d& at) {
  std::string text;
  constexpr int along = 200, across = 120;
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j <= across; ++j) {
      const double x = at.x() + 0.1 * i, y = at.y() - 6 + 0.1 * j;
      text += fmt::format("v {:.3f} {:.3f} {:.4f}\n", x, y, bed.height(x, y));
    }
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const int a = i * (across + 1) + j + 1, b = a + across + 1;
      text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", a, b, b + 1, a + 1);
    }
  return text;
}

struct Judged {
  double soundings = 0, far = 0, off = 0;  ///< more than 0.5 m away; more than three deviations and 5 cm
};

}  // namespace

class ProposedMission : public ToolTest {
 protected:
  /// Runs what `info` proposes for a scene, and exports the soundings. `viewpoint` is what the user knows.
  Judged judged(const std::string& scene, const RiverBed& bed, const std::string& viewpoint) const {
    std::string mission;
    const nlohmann::json described = json_of("info " + scene);
    for (const nlohmann::json& line : described["next"]) {
      std::string command = line.get<std::string>().substr(0, line.get<std::string>().find("  #"));
      if (const std::size_t at = command.find("x,y,z"); at != command.npos) command.replace(at, 5, viewpoint);
      if (command.starts_with("insonify prepare") || command.starts_with("insonify make-mission"))
        succeed(command.substr(9) + " -q");
      if (command.starts_with("insonify make-mission")) mission = command;
    }
    EXPECT_FALSE(mission.empty()) << scene;
    succeed("survey mission.toml -q -o run");
    succeed("merge -q run");
    succeed("export run --to csv -q -o soundings.csv");
    Judged j;
    for (const auto& row : rows_of(read("soundings.csv"))) {
      const auto number = [&](const char* name) { return std::stod(row.at(name)); };
      const double away = bed.distance({number("x_m"), number("y_m"), number("z_m")});
      j.soundings += 1, j.far += away > 0.5;
      j.off += away > std::max(0.05, 3 * number("deviation_m"));
    }
    for (const auto& [name, value] :
         {std::pair("soundings", j.soundings), std::pair("far", j.far), std::pair("off", j.off)}) {
      RecordProperty(scene + "_" + name, std::to_string(value));
      std::printf("  %s %s %g", scene.c_str(), name, value);
    }
    std::printf("\n");
    for (const char* made : {"run", "soundings.csv", "mission.toml", "prepared.ply"})
      std::filesystem::remove_all(path(made));
    return j;
  }
  void expect_trusted(const Judged& j) const {
    EXPECT_GT(j.soundings, 10000);
    EXPECT_LE(j.far, 0.001 * j.soundings);
    EXPECT_LE(j.off, 0.02 * j.soundings);
  }
};

TEST_F(ProposedMission, of_a_river_bed_in_projected_coordinates_374_m_high) {
  const RiverBed bed({500040, 5900020, 374});
  write("river.xyz", as_text(bed));
  expect_trusted(judged("river.xyz", bed, "500050,5900020,400"));
}

TEST_F(ProposedMission, of_a_cloud_in_its_own_axes) {
  const RiverBed bed({0, 0, -7});
  write("own.xyz", as_text(bed));
  expect_trusted(judged("own.xyz", bed, "10,0,5"));
}

TEST_F(ProposedMission, of_a_mesh) {
  const Eigen::Vector3d at(0, 0, -7);
  const RiverBed bed(at);
  write("bed.obj", as_mesh(bed, at));
  expect_trusted(judged("bed.obj", bed, ""));
}

// A depth camera's cloud: rows and columns, x to the right, y down, z ahead. It is pinged from where the camera was.
TEST_F(ProposedMission, of_a_cloud_in_the_axes_of_a_camera_is_a_ping_from_its_place) {
  constexpr int columns = 160, rows = 120;
  const Eigen::Vector3d camera(1, 2, 3);
  const auto ahead = [](double x, double y) { return 5 + 0.2 * std::sin(2 * x) * std::cos(1.5 * y); };
  std::string pcd = fmt::format(
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT {}\n"
      "VIEWPOINT 1 2 3 1 0 0 0\nPOINTS {}\nDATA ascii\n",
      columns, rows, columns * rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double u = (column - 79.5) / 140, v = (row - 59.5) / 140;
      double z = 5;
      for (int pass = 0; pass < 30; ++pass) z = ahead(u * z, v * z);
      pcd += fmt::format("{:.5f} {:.5f} {:.5f}\n", camera.x() + u * z, camera.y() + v * z, camera.z() + z);
    }
  write("camera.pcd", pcd);
  const nlohmann::json next = json_of("info camera.pcd")["next"];
  const std::string ping = next[0].get<std::string>();
  ASSERT_TRUE(ping.starts_with("insonify ping camera.pcd ")) << ping;
  succeed(ping.substr(9, ping.find("  #") - 9) + " -q");
  const Soundings returns = load_soundings(path("first/returns.ply"));
  ASSERT_GT(returns.size(), 100U);
  std::size_t near = 0;
  for (const Eigen::Vector3d& position : returns.position) {
    const Eigen::Vector3d p = position - camera;
    near += std::abs(p.z() - ahead(p.x(), p.y())) < 0.1;
  }
  EXPECT_GT(near, returns.size() * 98 / 100);
}

TEST_F(ProposedMission, of_tiles) {
  const RiverBed bed({0, 0, 12});
  write("bed.xyz", as_text(bed));
  succeed("prepare bed.xyz --viewpoint 10,0,40 -q -o bed.tiles");
  expect_trusted(judged("bed.tiles", bed, ""));
}

#ifdef INSONIFY_TEST_GDAL
TEST_F(ProposedMission, of_a_raster) {
  const RiverBed bed({0, 0, -7});
  std::string grid = "ncols 200\nnrows 120\nxllcorner 0\nyllcorner -6\ncellsize 0.1\n";
  for (int row = 0; row < 120; ++row)
    for (int column = 0; column < 200; ++column)
      grid += fmt::format("{:.4f}{}", bed.height(0.1 * column + 0.05, 5.95 - 0.1 * row), column < 199 ? ' ' : '\n');
  write("bed.asc", grid);
  expect_trusted(judged("bed.asc", bed, "10,0,5"));
}
#endif

TEST_F(ProposedMission, of_a_scene_of_parts) {
  const RiverBed bed({0, 0, -7});
  write("bed.xyz", as_text(bed));
  succeed("prepare bed.xyz --viewpoint 10,0,5 -q -o bed.ply");
  write("scene.toml", "schema = 1\n[[part]]\nname = \"bed\"\nfile = \"bed.ply\"\n");
  expect_trusted(judged("scene.toml", bed, ""));
}
