// SPDX-License-Identifier: BSD-3-Clause
// insonify-view: the interactive viewer, and its pictures without a display.
#include <cstdio>
#include <filesystem>

#include "files/path_status.hpp"
#include "run/parse_values.hpp"
#include "store/run_directory.hpp"
#include "tool/command/program.hpp"
#include "viewer/show_viewer.hpp"
#include "viewer/viewer_command.hpp"
#include "viewer/viewer_layout.hpp"

namespace insonify::viewer {
namespace {

// Checks the command line before reading data.
ViewerOptions options_of(const ViewerCommand& command) {
  ViewerOptions options;
  std::tie(options.width, options.height) = parse_size(command.size);
  in_words_of("--size = " + command.size, [&] { lay_out_viewer(options.width, options.height, ViewerMode::run, {}); });
  options.events = parse_viewer_script(command.script.empty() ? "" : read_text_file(command.script));
  for (const ViewerEvent& event : parse_viewer_script(command.events)) options.events.push_back(event);
  options.say = [](const std::string& text) {
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
  };
  if (const double window = command.start.window_db; !(window >= 5 && window <= 150))
    fail(ErrorKind::argument, "--window = ", window, " dB, must be 5 to 150");
  if (command.screenshot.empty() && !has_display())
    fail(ErrorKind::runtime,
         "no display: set DISPLAY, run under xvfb-run, or use insonify image (or --screenshot FILE.png)");
  if (!command.screenshot.empty())
    require_free_file(command.screenshot, command.force, {command.target, command.script});
  if (!path_exists(command.target)) fail(ErrorKind::file, command.target, ": no such run or scene");
  return options;
}

int view(int argc, char** argv) {
  const ViewerCommand command = parse_viewer_command(argc, argv);
  if (command.exit_code) return *command.exit_code;
  ViewerOptions options = options_of(command);
  const LoadedView loaded = is_run(command.target) ? load_run(command) : load_inspection(command);
  if (!command.common.quiet)
    for (const std::string& note : loaded.notes) tool::print_error("note: " + note);
  options.start = loaded.start;
  if (command.screenshot.empty()) {
    show_viewer(loaded.data, options);
  } else {
    draw_viewer(loaded.data, options, command.screenshot);
    std::printf("%s\n", command.screenshot.c_str());
  }
  return 0;
}

}  // namespace
}  // namespace insonify::viewer

int main(int argc, char** argv) {
  using namespace insonify;
  const char* less = "view a thinner scene, or a run with --no-scene";
  const auto run = [&] { return tool::run_program([&] { return viewer::view(argc, argv); }, less); };
  return tool::under_memory_guard(run, less);
}
