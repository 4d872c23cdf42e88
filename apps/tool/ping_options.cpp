#include "tool/ping_options.hpp"

#include "tool/run_settings.hpp"
#include "tool/shared_options.hpp"

namespace insonify::tool {

void add_ping_options(OptionList list, PingCommand& command, bool with_output) {
  // Values are written in the order of the options, so --run comes first and all others override it.
  const auto load_run = [list, &command](const std::string& path) mutable {
    command.options = command.of_run.emplace(load_ping_settings(path));
    list.release("SCENE");
    list.release("--sonar");
  };
  list.add(
      "--run", load_run,
      "run.toml of an earlier ping: the same again, but for the options given beside it; then SCENE and --sonar need "
      "not be given, and a flag is switched off by e.g. --noise=false");
  PingOptions& o = command.options;
  add_settings(list, scene_settings(o.scene));
  add_sonar(list, o.common, o.run);
  if (with_output) add_output(list, o.run);
  add_settings(list, ping_settings(o));
  add_common(list, o.common, true);
  add_work(list, o.common);
}

PingOptions settled_options(const PingCommand& command) {
  PingOptions o = command.options;
  if (!command.of_run) return o;
  const PingOptions &run = *command.of_run, defaults;
  const bool new_pose = o.pose != run.pose, new_trajectory = o.trajectory != run.trajectory;
  if (new_pose && !new_trajectory) o.trajectory.clear();
  if (!new_trajectory || new_pose) return o;
  // A trajectory says all that a pose and its motion say.
  o.pose.clear();
  if (o.world == run.world) o.world = defaults.world;
  if (o.velocity == run.velocity) o.velocity.clear();
  if (o.turn_rate == run.turn_rate) o.turn_rate.clear();
  return o;
}

}  // namespace insonify::tool
