// SPDX-License-Identifier: BSD-3-Clause
// Small files that announce much: refused at little cost of time and memory, in one line.
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/sanitizers.hpp"
#include "tool/tool_runner.hpp"

namespace {

class Cost : public ToolTest {
 protected:
  // Demands an exit code, one line unless it is 0, and that the tool took little.
  void expect_cheap(const std::string& arguments, int exit_code, const std::string& part) const {
    constexpr double most_seconds = 4, most_mib = 500;
    const std::string line = "cd '" + folder_.string() + "' && exec " INSONIFY_TOOL " " + arguments + " 2>'" +
                             path("../cost.err") + "' >/dev/null";
    const pid_t child = fork();
    if (child == 0) {
      const rlimit seconds{60, 60};
      setrlimit(RLIMIT_CPU, &seconds);
      execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
      _exit(99);
    }
    int status = -1;
    rusage used{};
    wait4(child, &status, 0, &used);
    const std::string text = insonify::file_bytes(path("../cost.err"));
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), exit_code) << arguments << ": " << text;
    EXPECT_THAT(text, HasSubstr(part)) << arguments;
    EXPECT_TRUE(exit_code == 0 || std::count(text.begin(), text.end(), '\n') == 1) << text;
    EXPECT_LT(static_cast<double>(used.ru_maxrss) / 1024, most_mib) << arguments;
    EXPECT_LT(static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec), most_seconds) << arguments;
  }

  // A ping's cube whose /pressure is taken away by `change`, which may put another there.
  void write_cube(const std::string& name, const std::function<void(hid_t file)>& change) const {
    have("harbour.ply", "make-scene harbour --points 2000");
    have("run", "ping harbour.ply --no-picture --sonar p900-45 --set sonar.beams=4 --pose=0,0,-3,0,10,0 --range 2:4");
    std::filesystem::copy_file(path("run/cube.h5"), path(name));
    std::filesystem::remove_all(path("run"));
    std::filesystem::remove(path("harbour.ply"));
    const hid_t file = H5Fopen(path(name).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    change(file);
    H5Fclose(file);
  }
};

std::string ones(const char* word) {
  std::string text;
  for (int i = 0; i < 10'000'000; ++i) text += word;
  return text;
}

// Puts an empty dataset of so many pings in the place of /pressure.
void announce_pings(hid_t file, hsize_t pings) {
  const hid_t old = H5Dopen2(file, "/pressure", H5P_DEFAULT), type = H5Dget_type(old), space = H5Dget_space(old);
  hsize_t extent[3];
  H5Sget_simple_extent_dims(space, extent, nullptr);
  H5Dclose(old);
  H5Ldelete(file, "/pressure", H5P_DEFAULT);
  extent[0] = pings;
  const hsize_t chunk[] = {1, extent[1], extent[2]};
  const hid_t sparse = H5Screate_simple(3, extent, nullptr), properties = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(properties, 3, chunk);
  const hid_t made = H5Dcreate2(file, "/pressure", type, sparse, H5P_DEFAULT, properties, H5P_DEFAULT);
  ASSERT_GE(made, 0);
  H5Dclose(made);
}

}  // namespace

TEST_F(Cost, of_clouds_that_announce_more_than_they_hold) {
  const std::string head = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nHEIGHT 1\n";
  const std::uint32_t sizes[] = {10, 3221225472};
  write("packed.pcd", head + "WIDTH 268435456\nPOINTS 268435456\nDATA binary_compressed\n" +
                          std::string(reinterpret_cast<const char*>(sizes), 8) + std::string(10, '\0'));
  expect_cheap("info packed.pcd", 3, "announces 3221225472 bytes of points in a compressed block of 10");
  std::string fields = "FIELDS", size = "\nSIZE", type = "\nTYPE", count = "\nCOUNT";
  for (int i = 0; i < 2000; ++i) fields += " f" + std::to_string(i), size += " 4", type += " F", count += " 1000000";
  write("wide.pcd", "VERSION .7\n" + fields + size + type + count + "\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2\n");
  expect_cheap("info wide.pcd", 3, "cut off");
}

// Headers of packets are of 256 bytes, those of their channels of 64.
TEST_F(Cost, of_recordings_that_repeat_and_that_reach_far) {
  const std::string side_scan = insonify::file_bytes(INSONIFY_RECORDS "/sidescan_scotsman.xtf");
  const std::string header = side_scan.substr(0, 1024);
  const auto repeated = [&](const std::string& packet, int times) {
    std::string file = header;
    for (int i = 0; i < times; ++i) file += packet;
    return file;
  };
  std::string packet = side_scan.substr(1024, 4480);
  write("repeated.xtf", repeated(packet, 100));
  expect_cheap("image repeated.xtf --view rect --animate -o frames", 0, "as a film");
  succeed("image repeated.xtf --view rect --ping 99 -q -o last.png");
  EXPECT_TRUE(read("frames/rect_000099.png") == read("frames/rect_000000.png"));
  EXPECT_TRUE(read("frames/rect_000099.png") == read("last.png"));

  const auto put = [](std::string& bytes, std::size_t at, auto number) {
    std::memcpy(bytes.data() + at, &number, sizeof number);
  };
  put(packet, 32, 1500.0F);
  for (const std::size_t trace : {256U, 256U + 64 + 2048})
    put(packet, trace + 4, 9001.0F), put(packet, trace + 12, 12.0F);
  write("far.xtf", repeated(packet, 30));
  for (const char* view : {"--altitude 5 --beam 0", ""})
    expect_cheap(std::string("image far.xtf --view waterfall -o far.png ") + view, 3,
                 "far.xtf: a picture from the head to 9000.99");

  std::string aris = insonify::file_bytes(INSONIFY_RECORDS "/sample.aris");
  const std::size_t frame = (aris.size() - 1024) / 2;
  for (const std::size_t head : {std::size_t{1024}, 1024 + frame})
    put(aris, head + 452, std::uint32_t{1}), put(aris, head + 476, std::uint32_t{16'000'000});
  write("far.aris", aris);
  expect_cheap("image far.aris --view waterfall --altitude 5 -o far.png", 3, "far.aris: its samples reach from");
}

TEST_F(Cost, of_one_line_of_20_megabytes) {
  const std::string row = ones("1 ");
  write("row.xyz", row);
  expect_cheap("info row.xyz", 3, "row.xyz:1: holds more than 4096 columns");
  write("row.csv", "x,y,z\n" + ones("1,"));
  expect_cheap("info row.csv", 3, "row.csv:2: holds more than 4096 columns");
  write("row.obj", "v 0 0 0\nf " + row);
  expect_cheap("info row.obj", 3, "row.obj:2: a face of more than 65535 corners");
  write("row.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
        "z\nend_header\n" +
            row);
  expect_cheap("info row.ply", 3, "found 10000000 words");
  write("row.toml", "schema = 1\nname = \"" + row);
  expect_cheap("sonars row.toml", 3, "row.toml:2");
}

TEST_F(Cost, of_scenes_and_titles_that_have_no_end) {
  expect_cheap("make-scene harbour --points 9223372036854775807 -o x.ply", 2, "GB of memory");
  expect_cheap("make-scene harbour --points 9223372036854775807 -o x.tiles", 4, "the disk has");
  expect_cheap("image none -o x.png --title " + std::string(100000, 'x'), 2, "--title of 100000 characters");
}

TEST_F(Cost, of_cubes_that_announce_more_than_they_hold) {
  for (const hsize_t pings : {hsize_t{20'000'000}, hsize_t{1} << 40}) {
    const std::string name = "sparse" + std::to_string(pings) + ".h5";
    write_cube(name, [&](hid_t file) { announce_pings(file, pings); });
    for (const char* verb : {"info ", "image -o x.png --view waterfall ", "export -o out "})
      expect_cheap(verb + name, 3, "/pressure announces");
  }
  write_cube("linked.h5", [](hid_t file) {
    H5Gclose(H5Gcreate2(file, "/layers", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    for (int i = 0; i < 10000; ++i)
      H5Lcreate_hard(file, "/pressure", file, ("/layers/" + std::to_string(i)).c_str(), H5P_DEFAULT, H5P_DEFAULT);
  });
  expect_cheap("info linked.h5", 3, "/layers holds 10000 members, must hold at most 64");
}

TEST_F(Cost, of_tables_of_materials) {
  std::string alike = "schema = 1\n";
  for (int i = 0; i < 3000; ++i)
    alike += "[[material]]\nname = \"m" + std::to_string(i) + "\"\nlike = \"medium-sand\"\n";
  write("alike.toml", alike);
  expect_cheap("info alike.toml", 0, "");
  std::string frequencies, strengths;
  for (int i = 1; i <= 5000; ++i) frequencies += std::to_string(i) + ", ", strengths += "-20, -25, -30, ";
  write("dense.toml", "schema = 1\n[[material]]\nname = \"a\"\nlaw = \"table\"\nincidence_deg = [0, 45, 80]\n" +
                          ("frequency_khz = [" + frequencies + "]\nsigma_db = [" + strengths + "]\n"));
  expect_cheap("info dense.toml", 3,
               "dense.toml:2: the laws of the materials up to 'a' have more than 256 frequencies");
}

TEST_F(Cost, of_mirrors_that_face_each_other) {
  have("sphere.ply", "make-scene sphere --points 2000");
  std::string walls;
  for (int i = 0; i < 300; ++i)
    walls +=
        "[[mirror]]\nplace_m = [" + std::to_string(9 + 0.01 * i) + ", 0, 0]\nnormal = [-1, 0, 0]\nsize_m = [2, 2]\n";
  write("walls.toml", walls);
  expect_cheap("ping sphere.ply --sonar p900-45 --pose=0,0,0,0,0,0 --environment walls.toml -o out", 3,
               "walls.toml:229: 300 mirrors, must be at most 57");
}

// Bodies of five surfels each: of one file, which is read once, and each with a label of its own.
TEST_F(Cost, of_many_parts_of_one_file) {
  write("dots.xyz",
        "x y z nx ny nz area\n0 0 0 -1 0 0 .01\n0 .1 0 -1 0 0 .01\n0 .2 0 -1 0 0 .01\n"
        "0 0 .1 -1 0 0 .01\n0 .1 .1 -1 0 0 .01\n");
  std::string parts = "schema = 1\n";
  for (int i = 0; i < 4000; ++i)
    parts += "[[part]]\nname = \"p" + std::to_string(i) + "\"\nfile = \"dots.xyz\"\nposition_m = [" +
             std::to_string(5 + i % 100 * 0.05) + ", " + std::to_string(-3 + i / 100 * 0.15) + ", -3]\n";
  write("parts.toml", parts);
  expect_cheap("info parts.toml --json", 0, "");
  expect_cheap(
      "ping parts.toml -q --sonar p900-45 --pose=0,0,-3,0,0,0 --range 1:11 --no-picture --keep contributors -o out", 0,
      "");
}

// Boxes of 150 surfels, which stand and which move, all in one position; on the first of them others rest.
TEST_F(Cost, of_many_parts_in_one_place) {
  write("box.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  have("bed.ply", "make-scene plane --points 2000 --size 20,20 --seed 1");
  const std::string files = "file = \"box.obj\"\nspacing_m = 0.2\n";
  std::string parts = "schema = 1\n[[part]]\nfile = \"bed.ply\"\n";
  for (int i = 0; i < 3000; ++i)
    parts += "[[part]]\nname = \"p" + std::to_string(i) + "\"\n" + files + "position_m = [4, 0, 1]\n" +
             (i % 3 == 0 ? "velocity_mps = [0.1, 0.2, 0]\n" : "");
  write("parts.toml", parts + "[[scatter]]\nfiles = [\"box.obj\"]\nspacing_m = 0.2\n" +
                          "names = [\"pot\"]\ncount = 12\nscale = [0.2, 0.2]\nmin_distance_m = 0.01\nrest = \"bed\"\n"
                          "area_m = [[4, 0], [5, 0], [5, 1], [4, 1]]\n");
  expect_cheap("ping parts.toml -q --sonar p900-45 --set sonar.beams=4 --pose=0,0,3,0,20,0 --range 1:10 -o out", 0, "");
}

// The data of a ping is kept where there is no memory for its picture, and no limit ends the tool by a signal.
TEST_F(Cost, under_a_limit_of_memory) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  have("harbour.ply", "make-scene harbour --points 20000");
  const std::string ping = "ping harbour.ply -q --sonar p900-45 --set sonar.beams=16 --pose=0,0,-3,0,10,0 --range 2:5";
  have("whole", ping.substr(0, ping.find(" -q")) + ping.substr(ping.find(" -q") + 3) + " --no-picture");
  int pictures = 0, without = 0;
  for (const int mib : {500, 700, 900, 3000}) {
    const auto limited = [&](const std::string& arguments) {
      write("line.sh", "cd '" + folder_.string() + "'; ulimit -v " + std::to_string(1024 * mib) +
                           "; exec " INSONIFY_TOOL " " + arguments + " >/dev/null 2>err");
      const int status = std::system(("bash '" + path("line.sh") + "'").c_str());
      return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    };
    const std::string out = "out" + std::to_string(mib);
    const int made = limited(ping + " -o " + out);
    if (made == 127) continue;  // the libraries themselves do not fit
    ASSERT_TRUE(made == 0 || made == 4) << mib << " MiB: " << made << read("err");
    if (made == 0) {
      EXPECT_TRUE(read(out + "/cube.h5") == read("whole/cube.h5"));
      const bool picture = std::filesystem::exists(path(out + "/fan.png"));
      ++(picture ? pictures : without);
      if (!picture) {
        EXPECT_THAT(read(out + "/manifest.json"), HasSubstr("too little memory for a picture"));
      }
    }
    const int drawn = limited("image whole -o " + out + ".png");
    EXPECT_TRUE(drawn == 0 || drawn == 4) << mib << " MiB: " << drawn << read("err");
    if (drawn == 4) {
      const std::string text = read("err");
      EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
      EXPECT_FALSE(std::filesystem::exists(path(out + ".png")));
    }
  }
  EXPECT_GT(pictures, 0);
  EXPECT_GT(without, 0);
}
