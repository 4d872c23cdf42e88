// SPDX-License-Identifier: BSD-3-Clause
// Files and disks that mean no good: one line, the right exit code, and nothing half-written.
#include <hdf5.h>
#include <sys/stat.h>

#include "tool/survey_fixture.hpp"

namespace fs = std::filesystem;

namespace {

class Hostile : public ToolTest {
 protected:
  // The tool in a process whose files may hold no more than `kib`, as on a full disk.
  ToolResult with_small_files(int kib, const std::string& arguments) const {
    const std::string line = "cd '" + folder_.string() + "' && ulimit -f " + std::to_string(kib) +
                             " && trap '' XFSZ && exec " INSONIFY_TOOL " " + arguments + " 2>'" + path("../err") +
                             "' >/dev/null";
    write("line.sh", line);
    const int status = std::system(("bash '" + path("line.sh") + "'").c_str());
    fs::remove(path("line.sh"));
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), "", insonify::file_bytes(path("../err"))};
  }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) names.insert(entry.path().string());
    return names;
  }
};

/// 5000 letters and blanks.
std::string prose() {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "abc d";
  return text;
}

const std::string small_ping =
    "ping harbour.ply --no-picture -q --sonar p900-45 --set sonar.beams=16 --pose=0,0,-3,0,10,0";

}  // namespace

TEST_F(Hostile, full_disk_is_one_line_and_leaves_the_old_run) {
  have("harbour.ply", "make-scene harbour --points 20000");
  succeed(small_ping + " --range 2:9 -o out");
  const std::string cube = read("out/cube.h5");
  const auto before = names();
  for (const int kib : {1, 16, 64, 128, 256})
    for (const std::string& command :
         {small_ping + " --range 2:20 --layers -o out --force", std::string("merge out out -o both -q"),
          std::string("export out -o vtk"), std::string("prepare harbour.ply -o again.ply"),
          std::string("prepare harbour.ply -o again.tiles")}) {
      const ToolResult result = with_small_files(kib, command);
      if (result.exit_code == 0) {
        for (const char* made : {"both", "vtk", "again.ply", "again.tiles"}) fs::remove_all(path(made));
        if (command.starts_with("ping")) ADD_FAILURE() << "the cube fits into " << kib << " KiB";
        continue;
      }
      EXPECT_EQ(result.exit_code, 4) << command << " with " << kib << " KiB: " << result.err;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      EXPECT_THAT(result.err, HasSubstr("File too large")) << command << " with " << kib << " KiB";
      EXPECT_EQ(names(), before) << command << " with " << kib << " KiB";
      EXPECT_TRUE(read("out/cube.h5") == cube);
    }
}

// A picture is larger than the cube of so small a ping, and a picture of labels larger than what it says of them.
TEST_F(Hostile, a_run_whose_picture_finds_the_disk_full_is_no_run) {
  have("harbour.ply", "make-scene harbour --points 20000");
  const std::string drawn =
      "ping harbour.ply -q --sonar p900-45 --set sonar.beams=4 --pose=0,0,-3,0,10,0 --range 4:6 --keep contributors";
  const std::string labels = "image whole --view labels -q --size 4000x3000 -o labels.png";
  succeed(drawn + " -o whole");
  succeed(labels);
  write("echoes.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n5,0,0,0.01,0.6,-0.3\n");
  const auto kib = [&](const char* name) { return static_cast<int>(fs::file_size(path(name)) / 1024); };
  const int room_for_palette = kib("labels.json") + 1;
  ASSERT_LT(kib("whole/contributors.h5"), kib("whole/fan.png"));
  ASSERT_LT(room_for_palette, kib("labels.png"));
  for (const char* name : {"labels.png", "labels.json"}) fs::remove(path(name));
  const auto before = names();
  for (const auto& [arguments, room] :
       {std::pair(drawn + " -o out", kib("whole/fan.png")),
        std::pair(std::string("synthesize echoes.csv -q --sonar p900-45 --set sonar.beams=4 --range 4:6 -o out"), 30),
        std::pair(labels, room_for_palette)}) {
    const ToolResult result = with_small_files(room, arguments);
    EXPECT_EQ(result.exit_code, 4) << arguments << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr(".png: cannot be written: File too large"));
    EXPECT_EQ(names(), before) << arguments;
  }
}

TEST_F(Hostile, pipes_and_devices_are_no_input) {
  ASSERT_EQ(mkfifo(path("pipe.ply").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(path("pipe.toml").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(path("pipe.npy").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(path("pipe.aris").c_str(), 0600), 0);
  for (const char* arguments : {"info pipe.ply", "info /dev/zero", "prepare pipe.ply -o x.ply", "sonars pipe.toml",
                                "survey pipe.toml -o run", "compare pipe.npy pipe.npy", "compare pipe.aris pipe.aris"})
    expect_refused(arguments, 4, {"is a pipe or a device, must be a regular file"});
}

// Whatever a verb asks of a path first.
TEST_F(Hostile, links_to_themselves_are_no_input) {
  have("harbour.ply", "make-scene harbour --points 2000");
  succeed(small_ping + " --range 2:9 -o out");
  for (const char* name : {"loop", "loop.ply", "loop.tiles", "loop.toml", "loop.h5", "loop.xtf", "loop.csv"})
    fs::create_symlink(name, path(name));
  write("m.toml", replaced(survey_mission, "harbour.ply", "loop.ply"));
  const std::string head = " --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:9 -o x";
  for (const std::string& arguments : {std::string("info loop"),
                                       std::string("info loop.ply"),
                                       std::string("info loop.toml"),
                                       std::string("info loop.h5"),
                                       std::string("info --verify loop"),
                                       std::string("prepare loop.ply -o x.ply"),
                                       std::string("prepare loop.ply -o x.tiles"),
                                       std::string("make-mission orbit --scene loop.ply -o x.toml"),
                                       std::string("sonars loop.toml"),
                                       std::string("plan loop.ply") + head.substr(0, head.size() - 5),
                                       "ping loop.ply" + head,
                                       "ping loop.tiles" + head,
                                       "ping loop.toml" + head,
                                       "ping harbour.ply --environment loop.toml" + head,
                                       "ping harbour.ply --materials loop.toml" + head,
                                       std::string("ping --run loop.toml -o x"),
                                       std::string("survey loop.toml -o x"),
                                       std::string("survey m.toml -o x"),
                                       std::string("survey m.toml -o loop"),
                                       std::string("synthesize loop.csv --sonar p900-45 --range 2:9 -o x"),
                                       std::string("image loop -o x.png"),
                                       std::string("image loop.h5 -o x.png"),
                                       std::string("image loop.xtf -o x.png"),
                                       std::string("image loop.ply --view scene -o x.png"),
                                       std::string("export loop -o x"),
                                       std::string("export loop.h5 -o x"),
                                       std::string("compare loop out"),
                                       std::string("compare out loop"),
                                       std::string("compare out loop.ply"),
                                       std::string("dataset loop -o x"),
                                       std::string("merge loop -o x"),
                                       std::string("merge out loop -o x"),
                                       std::string("merge loop.h5 out -o x"),
                                       std::string("export out -o loop/x"),
                                       std::string("merge out out -o loop"),
                                       std::string("view loop --screenshot x.png")})
    expect_refused(arguments, 4, {"loop"});
}

TEST_F(Hostile, keys_of_very_many_parts_are_refused) {
  std::string key = "a";
  for (int i = 0; i < 100000; ++i) key += ".a";
  write("deep.toml", "schema = 1\n" + key + " = 1\n");
  write("table.toml", "schema = 1\n[" + key + "]\n");
  for (const char* file : {"deep.toml", "table.toml"})
    expect_refused(std::string("sonars ") + file, 3, {file, ":2", "key of more than 64 parts"});
}

TEST_F(Hostile, names_that_no_other_program_can_read_are_refused_before_the_work) {
  have("harbour.ply", "make-scene harbour --points 2000");
  const ToolResult result = run(small_ping + " --range 2:9 -o r\xffn");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("not UTF-8"));
  succeed("make-scene harbour --points 2000 -o 'd\x7fl.ply'");
  succeed(
      "ping 'd\x7fl.ply' --no-picture -q --sonar p900-45 --set sonar.beams=4 --pose=0,0,-3,0,10,0 --range 2:9 -o out");
  succeed("ping --run out/run.toml --no-picture -q -o again");
  EXPECT_TRUE(read("out/cube.h5") == read("again/cube.h5"));
}

TEST_F(Hostile, cubes_do_not_read_files_elsewhere) {
  have("harbour.ply", "make-scene harbour --points 2000");
  succeed(small_ping + " --range 2:5 -o out");
  fs::copy_file(path("out/cube.h5"), path("secret.h5"));
  const hid_t file = H5Fopen(path("out/cube.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  ASSERT_GE(H5Ldelete(file, "/pressure", H5P_DEFAULT), 0);
  ASSERT_GE(H5Lcreate_external("../secret.h5", "/pressure", file, "/pressure", H5P_DEFAULT, H5P_DEFAULT), 0);
  H5Fclose(file);
  expect_refused("image out -o x.png", 3, {"cube.h5", "/pressure is a link to elsewhere"});
}

TEST_F(Hostile, messages_cut_texts_of_5000_letters) {
  const auto expect_short = [&](const std::string& arguments, std::vector<int> codes) {
    const ToolResult result = run(arguments);
    EXPECT_THAT(codes, testing::Contains(result.exit_code)) << arguments.substr(0, 80) << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr(" ... "));
    EXPECT_LT(result.err.size(), 600U) << result.err;
  };
  write("box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const std::string ping = "ping box.obj --sonar p900-45 --pose=0,0,-3,0,10,0 -o out ";
  for (const std::string& text : {std::string(5000, 'x'), prose()}) {
    const std::string quoted = "'" + text + "'";
    expect_short(ping + "--material " + quoted, {2});
    expect_short(ping + "--set sonar.beams=" + quoted, {2});
    expect_short("ping box.obj -o out --pose=0,0,0,0,0,0 --sonar " + quoted, {2});
    write("materials.toml", "schema = 1\n[[material]]\nname = \"a\"\nlike = \"" + text + "\"\n");
    expect_short(ping + "--materials materials.toml", {3});
    write("mission.toml", "schema = 1\n[survey]\n\"" + text + "\" = 1\n");
    expect_short("survey mission.toml -o out", {3});
    write("run.toml", "insonify_version = \"0\"\nmethod = \"" + text + "\"\n[sonar]\n[ping]\n");
    expect_short("ping --run run.toml -o out", {3});
    write("scene.toml", "schema = 1\n[[part]]\nfile = \"box.obj\"\nmaterial = \"" + text + "\"\n");
    expect_short("info scene.toml", {3});
  }
  expect_short("ping " + std::string(5000, 'x') + " --sonar p900-45 --pose=0,0,0,0,0,0 -o out", {4});
  expect_short("image none -o a.png --view " + std::string(5000, 'x'), {2});
}

TEST_F(Hostile, messages_list_ten_of_5000_names) {
  std::string text = "schema = 1\nmission_sha256 = \"0\"\n";
  for (int i = 1; i <= 5000; ++i)
    text += "[[head]]\nname = \"h" + std::to_string(i) + "\"\npings = 1\npings_per_block = 1\n";
  fs::create_directory(path("many"));
  write("many/survey.toml", text);
  for (const char* command : {"export many --head none --to csv -o a.csv", "image many --head none -o a.png"}) {
    const ToolResult refused = run(command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_THAT(refused.err, HasSubstr("h1, h2, h3, h4, h5, h6, h7, h8, h9, h10 and 4990 more\n")) << command;
  }
  const ToolResult merged = run("merge many");
  EXPECT_EQ(merged.exit_code, 3);
  EXPECT_THAT(merged.err, HasSubstr("h10/blocks/000000 (pings 0 to 0) and 4990 more; run the survey"));
}
