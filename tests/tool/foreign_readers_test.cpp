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
  /// What a command of the shell prints, in the folder of the test; nothing if it fails.
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
            for d in f.values():
                if isinstance(d, h5py.Dataset):
                    assert d.attrs["long_name"], d.name
print("read")
)x");
  EXPECT_EQ(output_of("/usr/bin/python3 read.py"), "read\n") << read("said.txt");
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
