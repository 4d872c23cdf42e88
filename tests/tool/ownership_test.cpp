// SPDX-License-Identifier: BSD-3-Clause
// Tests what --force may replace: files that a run wrote, and never an input, whatever it is called.
#include "tool/tool_runner.hpp"

using namespace insonify;
namespace fs = std::filesystem;

namespace {

/// A verb that makes a folder; OUT stands for the folder, IN for the input that a test may place inside it.
struct FolderCommand {
  const char *verb, *arguments;
  const char* input;           ///< what IN is a copy of
  const char* extension = "";  ///< end of the name of OUT; empty if OUT is a folder
};
constexpr FolderCommand folder_commands[] = {
    {"ping", "IN --sonar p900-45 --pose=0,0,2,0,30,0 --range 2:5 --no-picture -o OUT", "plane.ply"},
    {"synthesize", "IN --sonar p900-45 --range 1:4 --no-picture -o OUT", "points.csv"},
    {"merge", "IN -o OUT", "run"},
    {"export", "IN -o OUT", "run"},
    {"export", "IN --to png -o OUT", "run"},
    {"compare", "IN run -o OUT", "run"},
    {"dataset", "IN -o OUT", "run"},
    {"image", "IN --view rect --animate -o OUT", "run"},
    {"accuracy",
     "--scene IN --sonar p900-45 --pose=0,0,2,0,30,0 --range 3.9:4.1 --quick --repeats 1 --methods direct --set "
     "sonar.beams=4 --no-picture -o OUT",
     "plane.ply"}};

/// A verb that makes one file.
constexpr FolderCommand file_commands[] = {{"make-scene", "plane --points 500 -o OUT", "", ".ply"},
                                           {"prepare", "IN -o OUT", "plane.ply", ".ply"},
                                           {"prepare", "IN -o OUT --thin 0.5", "plane.ply", ".ply"},
                                           {"make-mission", "lawnmower --scene IN -o OUT", "plane.ply", ".toml"},
                                           {"image", "IN --view grey -o OUT", "run", ".png"},
                                           {"export", "IN --to csv -o OUT", "run", ".csv"},
                                           {"export", "IN --to gsf --anchor 54.1,7.9 -o OUT", "run", ".gsf"},
                                           {"export", "IN --to las --anchor 54.1,7.9 -o OUT", "run", ".las"},
                                           {"export", "IN --to geotiff --anchor 54.1,7.9 -o OUT", "run", ".tif"},
                                           {"export", "IN --to mcap -o OUT", "run", ".mcap"},
                                           {"beampattern", "IN -o OUT", "sonar.toml", ".png"},
                                           {"view", "IN --screenshot OUT", "run", ".png"}};

class Ownership : public ToolTest {
 protected:
  void SetUp() override {
    have("plane.ply", "make-scene plane --points 500 --size 6,4");
    write("points.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n2,0.1,0,0.05,1,0\n");
    have("run",
         "ping plane.ply --sonar p900-45 --pose=0,0,2,0,30,0 --range 2:5 --no-picture --keep contributors "
         "--set sonar.beams=32");
    write("sonar.toml", read("run/run.toml"));
  }

  std::string line(const FolderCommand& command, const std::string& input, const std::string& output) const {
    std::string text = command.arguments;
    for (const auto& [word, value] : {std::pair("IN", input), std::pair("OUT", output)})
      if (const auto at = text.find(word); at != std::string::npos) text.replace(at, std::strlen(word), value);
    return std::string(command.verb) + " " + text + " --force -q";
  }
  /// Names and contents of all files below the test's folder.
  std::map<std::string, std::string> everything() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      files[entry.path().string()] = entry.is_regular_file() ? file_bytes(entry.path().string()) : "";
    return files;
  }
  /// Demands exit code 4, one line that holds `part`, and that nothing has changed.
  void expect_untouched(const std::string& arguments, const std::string& part) const {
    const auto before = everything();
    expect_refused(arguments, 4, {part});
    EXPECT_TRUE(before == everything()) << arguments;
  }
  void copy(const std::string& from, const std::string& to) const {
    fs::create_directories(fs::path(path(to)).parent_path());
    fs::copy(path(from), path(to), fs::copy_options::recursive);
  }
  void remove(const std::string& name) const { fs::remove_all(path(name)); }
};

}  // namespace

TEST_F(Ownership, a_folder_with_files_of_others_is_kept) {
  for (const FolderCommand& command : folder_commands) {
    SCOPED_TRACE(command.verb);
    // A file beside those of the run, one in a folder below, and one of the run that was changed.
    copy("run", "old");
    write("old/thesis.tex", "years of work");
    expect_untouched(line(command, command.input, "old"), "thesis.tex");
    remove("old/thesis.tex");
    fs::create_directory(path("old/notes"));
    write("old/notes/a.txt", "mine");
    expect_untouched(line(command, command.input, "old"), "notes/a.txt");
    remove("old/notes");
    write("old/run.toml", read("old/run.toml") + "# tuned by hand\n");
    expect_untouched(line(command, command.input, "old"), "run.toml");
    remove("old");
    // A folder that no run made, and one whose manifest is another program's.
    fs::create_directory(path("home"));
    write("home/cube.h5", "mine");
    expect_untouched(line(command, command.input, "home"), "cube.h5");
    write("home/manifest.json", "{\"sha256\": {\"cube.h5\": \"\"}}");
    expect_untouched(line(command, command.input, "home"), "cube.h5");
    remove("home");
  }
}

TEST_F(Ownership, a_folder_that_is_or_holds_the_input_is_kept) {
  for (const FolderCommand& command : folder_commands) {
    SCOPED_TRACE(command.verb);
    const std::string input = command.input;
    copy("run", "old");
    // The input lies inside, and is even one of the old run's own files.
    copy(input, "old/in" + fs::path(input).extension().string());
    const std::string inside = "old/in" + fs::path(input).extension().string();
    expect_untouched(line(command, inside, "old"), "holds the input");
    expect_untouched(line(command, "./" + inside, "../" + folder_.filename().string() + "/old/"), "holds the input");
    fs::create_symlink(path(inside), path("elsewhere" + fs::path(input).extension().string()));
    expect_untouched(line(command, "elsewhere" + fs::path(input).extension().string(), "old"), "holds the input");
    fs::create_directory_symlink(path("old"), path("link"));
    expect_untouched(line(command, inside, "link"), "holds the input");
    // The input is the output.
    remove("old"), remove("link"), remove("elsewhere" + fs::path(input).extension().string());
    copy(input, "same" + fs::path(input).extension().string());
    const std::string same = "same" + fs::path(input).extension().string();
    expect_untouched(line(command, same, same), "is the input");
    fs::create_symlink(path(same), path("link"));
    expect_untouched(line(command, same, "link"), "is the input same");
    remove("link"), remove(same);
  }
  expect_untouched("export run/cube.h5 -o run --force", "holds the input run/cube.h5");
  expect_untouched("ping --run run/run.toml -o run --force", "holds the input");
  expect_untouched("ping run/returns.ply --sonar p900-45 --pose=0,0,2,0,30,0 -o run --force", "holds the input");
}

TEST_F(Ownership, a_file_that_is_an_input_is_kept) {
  for (const FolderCommand& command : file_commands) {
    SCOPED_TRACE(std::string(command.verb) + command.arguments);
    if (*command.input == 0) continue;
    const std::string input = command.input;
    if (!fs::is_directory(path(input))) {
      const std::string extension = fs::path(input).extension().string();
      expect_untouched(line(command, input, input), "is the input");
      expect_untouched(line(command, input, "../" + folder_.filename().string() + "/" + input),
                       "is the input " + input);
      fs::create_symlink(path(input), path("link" + extension));
      expect_untouched(line(command, input, "link" + extension), "is the input " + input);
      expect_untouched(line(command, "link" + extension, input), "is the input link" + extension);
      remove("link" + extension);
    } else {
      expect_untouched(line(command, input, input), "is the input");
      for (const char* own : {"cube.h5", "returns.ply", "run.toml", "manifest.json"})
        expect_untouched(line(command, input, input + "/" + own), "is a file of the input run");
    }
  }
}

TEST_F(Ownership, an_output_file_replaces_that_file_alone_and_only_with_force) {
  for (const FolderCommand& command : file_commands) {
    SCOPED_TRACE(std::string(command.verb) + command.arguments);
    const std::string output = std::string("out") + command.extension;
    write(output, "old");
    write("neighbour.png", "mine");
    const std::string forced = line(command, command.input, output);
    const std::string unforced = forced.substr(0, forced.find(" --force"));
    expect_untouched(unforced, "exists already");
    succeed(forced);
    EXPECT_NE(read(output), "old");
    EXPECT_EQ(read("neighbour.png"), "mine");
    remove(output);
  }
}

TEST_F(Ownership, a_folder_of_every_verb_is_replaced_by_the_same_verb) {
  for (const FolderCommand& command : folder_commands) {
    SCOPED_TRACE(std::string(command.verb) + command.arguments);
    succeed(line(command, command.input, "out"));
    succeed(line(command, command.input, "out"));
    EXPECT_EQ(succeed("info out --verify").find("changed"), std::string::npos);
    // A link to a run stays a link, and the folder behind it is the new run.
    fs::create_directory_symlink(path("out"), path("link"));
    succeed(line(command, command.input, "link"));
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_TRUE(fs::exists(path("out/manifest.json")));
    remove("link"), remove("out");
  }
}
