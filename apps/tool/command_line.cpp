#include "tool/command_line.hpp"

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "tool/verb_options_internal.hpp"
#include "tool/verbs.hpp"

namespace insonify::tool {

Command parse_command_line(int argc, char** argv) {
  // The viewer reads its own options.
  if (argc > 1 && std::string(argv[1]) == "view")
    return {[arguments = std::vector<std::string>(argv + 2, argv + argc)] { view(arguments); }, 0};

  const auto all = std::make_shared<AllOptions>();
  CLI::App app{"insonify: what a sonar hears of a captured scene", "insonify"};
  app.set_version_flag("--version", INSONIFY_VERSION);
  app.require_subcommand(1);
  add_info(app, *all);
  add_prepare(app, *all);
  add_make_scene(app, *all);
  add_sonars(app, *all);
  add_plan(app, *all);
  add_ping(app, *all);
  add_synthesize(app, *all);
  add_image(app, *all);
  add_export(app, *all);
  add_merge(app, *all);
  add_beampattern(app, *all);
  add_accuracy(app, *all);
  app.add_subcommand("view", "the interactive viewer: a run, or a scene before any ping; see insonify view --help");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // help and version: asked for, so on stdout
    return {{}, app.exit(e)};
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "insonify: %s; see insonify --help\n", e.what());
    return {{}, 2};
  }
  const std::string verb = app.get_subcommands().front()->get_name();
  return {[all, verb] {
            if (verb == "info") info(all->common, all->info);
            if (verb == "prepare") prepare(all->common, all->prepare);
            if (verb == "make-scene") make_scene(all->common, all->make_scene);
            if (verb == "sonars") sonars(all->common, all->sonars);
            if (verb == "plan") plan(all->common, all->ping);
            if (verb == "ping") ping(all->common, all->ping);
            if (verb == "synthesize") synthesize(all->common, all->synthesize);
            if (verb == "image") image(all->common, all->image);
            if (verb == "export") export_run(all->common, all->exporting);
            if (verb == "merge") merge(all->common, all->merge);
            if (verb == "accuracy") accuracy(all->common, all->accuracy);
            if (verb == "beampattern") beampattern(all->common, all->beampattern);
          },
          0};
}

}  // namespace insonify::tool
