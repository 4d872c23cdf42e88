// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "run_scenes/run_folder.hpp"
#include "store/run_directory.hpp"
#include "store/sonar_file.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct SonarsOptions {
  CommonOptions common;
  std::string name;
  bool toml = false;
};

void add_options(OptionList list, SonarsOptions& o) {
  list.add("NAME", &o.name, "name of a preset, or a .toml file");
  list.add("--toml", &o.toml, "print the file, as a start for one of your own");
  add_common(list, o.common);
}

ordered_json sonar_json(const SonarFile& file) {
  return {{"name", file.spec.name},
          {"description", file.description},
          {"path", file.path},
          {"numbers", numbers_json(file.numbers)}};
}

void print_one(const SonarFile& file) {
  fmt::print("{}: {}\n\n", file.spec.name, file.description);
  for (const SourcedNumber& n : file.numbers)
    fmt::print("  {:<22} {:>10}  {:<9} {}\n", n.key, n.value, n.status, n.source);
  const SonarHead head = make_head(file.spec, nominal_sound_speed);
  fmt::print("\n  range resolution at {:g} m/s: {:.3g} mm (full width at half intensity), {:.3g} mm (c / 2B)\n",
             nominal_sound_speed, 1e3 * range_resolution(head.pulse, nominal_sound_speed),
             1e3 * nominal_range_resolution(head.pulse, nominal_sound_speed));
}

void print_table(const std::vector<SonarFile>& files) {
  fmt::print("{:<20} {:>9} {:>9} {:>6} {:>6} {:>12}  {}\n", "name", "kHz", "fan deg", "beams", "deg", "range m",
             "description");
  for (const SonarFile& f : files) {
    const SonarSpec& s = f.spec;
    fmt::print("{:<20} {:>9.4g} {:>5.3g}x{:<3.3g} {:>6} {:>6.3g} {:>12}  {}\n", s.name, s.centre_frequency * 1e-3,
               degrees(s.field_of_view), degrees(s.elevation_width), s.beams, degrees(s.beam_width),
               fmt::format("{:g}-{:g}", s.min_range, s.max_range), f.description);
  }
}

void sonars(const SonarsOptions& o) {
  if (o.toml) {
    if (o.name.empty())
      fail(ErrorKind::argument, "--toml needs the name of a sonar, e.g. insonify sonars p900-45 --toml");
    std::fputs(read_text_file(find_sonar(o.name).path).c_str(), stdout);
    return;
  }
  if (!o.name.empty()) {
    const SonarFile file = find_sonar(o.name);
    return print_result(o.common, sonar_json(file), [&] { print_one(file); });
  }
  const std::vector<SonarFile> files = list_sonars();
  ordered_json all = ordered_json::array();
  for (const SonarFile& f : files) all.push_back(sonar_json(f));
  print_result(o.common, all, [&] { print_table(files); });
}

}  // namespace

Verb sonars_verb() {
  return make_verb<SonarsOptions>(
      "sonars", "the presets; with a name, all numbers of one with their sources",
      {"insonify sonars", "insonify sonars oculus-m750d", "insonify sonars oculus-m750d --toml > my-sonar.toml"},
      add_options, sonars);
}

}  // namespace insonify::tool
