// SPDX-License-Identifier: BSD-3-Clause
// Every product of a survey with two heads, opened by programs of others where they are installed.
#include "scene_io/load_scene.hpp"
#include "tool/survey_fixture.hpp"

using namespace insonify;

class ForeignReaders : public SurveyTest {
 protected:
  void SetUp() override {
    SurveyTest::SetUp();
    write("m.toml",
          replaced(survey_mission, "seed = 7", "seed = 7\nanchor = { latitude_deg = 54.1, longitude_deg = 7.9 }"));
    survey("run");
    succeed("merge -q run");
  }
  /// Returns what a command of the shell prints in the folder of the test; nothing if it fails.
  std::string output_of(const std::string& command) const {
    const std::string line = "cd " + folder_.string() + " && (" + command + ") >said.txt 2>&1";
    return std::system(line.c_str()) == 0 ? read("said.txt") : "";
  }
};

TEST_F(ForeignReaders, h5py_knows_the_cubes_of_both_heads) {
  if (output_of("/usr/bin/python3 -c 'import h5py; print(1)'").empty()) GTEST_SKIP() << "python3-h5py is not installed";
  write("read.py", R"x(import h5py, numpy
for head, beams in (("fls", 16), ("turning", 1)):
    for name in ("run/%s/cube.h5" % head, "run/%s/blocks/000000.h5" % head):
        with h5py.File(name) as f:
            p = f["pressure"]
            assert p.shape[1] == beams and f.attrs["head"] == head and f.attrs["anchor_latitude_deg"] == 54.1
            assert [d.label for d in p.dims] == ["ping", "beam", "bin"]
            assert numpy.array_equal(p.dims[2][0][:], f["range"][:]) and f["range"].attrs["CLASS"] == b"DIMENSION_SCALE"
            assert "sqrt(2)" in p.attrs["convention"] and p.attrs["units"] == "Pa"
            assert p.dtype == "complex64" and p.is_virtual == name.endswith("cube.h5")
            assert p.dims[1][0] == f["azimuth"] and p.dims[0][0] == f["ping"]
            assert "port" in f["azimuth"].attrs["long_name"] and f["pose"].attrs["units"] == "1, 1, 1, m"
            for d in f.values():
                if isinstance(d, h5py.Dataset):
                    assert d.attrs["long_name"], d.name
with h5py.File("run/fls/cube.h5") as f:
    p = f["pressure"]
    print(*p.shape, f["time"][5], repr(float(abs(p[5, 3, 4].real))))
)x");
  std::istringstream words(output_of("/usr/bin/python3 read.py"));
  const Cube cube = cube_of("run/fls");
  std::size_t pings = 0, beams = 0;
  Eigen::Index bins = 0;
  double time = 0, real = 0;
  ASSERT_TRUE(words >> pings >> beams >> bins >> time >> real) << read("said.txt");
  EXPECT_EQ(pings, cube.pings.size());
  EXPECT_EQ(beams, cube.pings[0].fan.beams());
  EXPECT_EQ(bins, cube.pings[0].pressure.cols());
  EXPECT_EQ(time, 2.5);
  EXPECT_EQ(static_cast<float>(real), std::abs(cube.pings[5].pressure(3, 4).real()));
}

TEST_F(ForeignReaders, gdal_opens_the_grids_of_both_heads) {
  if (output_of("gdalinfo --version").empty()) GTEST_SKIP() << "gdal-bin is not installed";
  for (const std::string head : {"fls", "turning"}) {
    succeed("export run --head " + head + " --to geotiff --cell 1 -q -o " + head + ".tif");
    EXPECT_THAT(
        output_of("gdalinfo -stats " + head + ".tif"),
        testing::AllOf(HasSubstr("EPSG\",32632"), HasSubstr("Description = highest"), HasSubstr("STATISTICS_MEAN")));
  }
}

TEST_F(ForeignReaders, pcl_takes_every_column_of_the_returns) {
  if (output_of("command -v pcl_ply2pcd").empty()) GTEST_SKIP() << "pcl-tools is not installed";
  const std::string said = output_of("pcl_ply2pcd run/returns.ply returns.pcd");
  const std::size_t points = load_soundings(path("run/returns.ply")).size();
  EXPECT_THAT(said, HasSubstr(std::to_string(points) + " points"));
  EXPECT_THAT(
      read("returns.pcd").substr(0, 600),
      HasSubstr("FIELDS x y z scalar_level_db scalar_range scalar_azimuth scalar_elevation scalar_ping "
                "scalar_beam scalar_bin scalar_true_elevation scalar_true_surfel scalar_true_material scalar_time "
                "scalar_head"));
}
