// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/stop_watch.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "files/sha256.hpp"
#include "run/parse_values.hpp"
#include "run/run_checks.hpp"
#include "store/csv_tables.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/image/image.hpp"
#include "tool/image/survey_heads_drawn.hpp"
#include "tool/run/record_file.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> views_with(const std::string& option) {
  std::vector<std::string> names;
  for (const ViewSpec& view : all_views())
    for (const ViewOption& each : view.options)
      if (each.name == option) names.emplace_back(view.name);
  return names;
}

/// Every option that not all views take, once.
std::vector<ViewOption> options_of_views() {
  std::vector<ViewOption> options;
  for (const ViewSpec& view : all_views())
    for (const ViewOption& option : view.options)
      if (view.name == views_with(option.name).front()) options.push_back(option);
  return options;
}

/// "fan, rect or panels".
std::string alternatives(std::vector<std::string> names) {
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : joined(names) + " or " + last;
}

void add_options(OptionList list, ImageOptions& o) {
  std::vector<std::string> names, views;
  for (const ViewSpec& view : all_views()) {
    names.emplace_back(view.name);
    views.push_back(fmt::format("{}: {}", view.name, view.shows));
  }
  list.add("RUN", &o.run,
           "run directory, folder of a survey, cube.h5, or a recording (" + record_extensions() +
               "); for view scene also a cloud or mesh",
           {.required = true});
  list.add("-o,--output", &o.output, "picture that is written, .png (grey also .pgm); with --animate a folder",
           {.required = true});
  list.add("--view", &o.view, joined(views, "; "), {.words = names});
  list.add("--bits", &o.bits, "bits of view grey: 8 or 16", {.words = {"8", "16"}, .shown_as = "INT"});
  list.add("--layer", &o.layer, "kind of echo that is shown alone, e.g. multipath; the run must be made with --layers");
  list.add("--ping", &o.ping, "number of the ping, from 0");
  list.add(
      "--head", &o.head,
      "name of the head of a survey; default: a picture for each head, both sides of a side-scan in one waterfall");
  list.add(
      "--beam", &o.beam,
      "number of the beam from 0, or max (waterfall), or all (spectrum); default: the middle beam, for spectrum all");
  list.add("--raw", &o.raw, "show levels as received; default: range compensated; excludes --tvg", {.shown_as = " "});
  const auto take_tvg = [&o](const std::string& text) { o.tvg = parse_number("--tvg", text); };
  list.add("--tvg", take_tvg,
           "[dB per decade of range] time-varied gain, to which absorption is added; 40: for points, 30: for a bottom; "
           "default: 40, for a recording 0",
           {.excludes = "--raw", .shown_as = "FLOAT"});
  PictureOptions& picture = o.picture;
  const auto take_max = [&picture](const std::string& text) { picture.max_db = parse_number("--max", text); };
  const auto take_size = [&picture](const std::string& text) {
    std::tie(picture.width, picture.height) = parse_size(text);
    picture.trim = false;
  };
  list.add("--window", &picture.window_db, "[dB] difference between the brightest and the darkest level");
  list.add("--max", take_max, "[dB] brightest level; default: automatic");
  list.add("--colormap", &picture.colour_map, joined(colour_map_names()), {.words = colour_map_names()});
  list.add("--size", take_size, "WIDTHxHEIGHT [pixels]; default: 1400x1050, trimmed to the fan");
  list.add("--title", &picture.title, "title of the picture; default: sonar and ping");
  list.add("--dark", &picture.dark, "draw on a dark background");
  list.add("--force", &o.force, "replace existing pictures");
  for (ViewOption& option : options_of_views()) {
    const std::vector<std::string> takers = views_with(option.name);
    const std::string group = (takers.size() > 1 ? "Of views " : "Of view ") + alternatives(takers);
    option.rules.group = group.c_str();
    std::visit([&](auto member) { list.add(option.name, &(o.*member), option.help, option.rules); }, option.value);
  }
  add_common(list, o.common);
}

/// Throws Error(argument) for a number without meaning, or a title that no picture has room for.
void require_drawable(const ImageOptions& o) {
  constexpr std::size_t most = 1000;
  if (const double window = o.picture.window_db; !(window > 0 && window <= 1000))
    fail(ErrorKind::argument, "--window = ", window, " dB, must be > 0 and at most 1000");
  if (o.tvg && !(std::abs(*o.tvg) <= 1000))
    fail(ErrorKind::argument, "--tvg = ", *o.tvg, " dB, must be within -1000 and 1000");
  if (const std::size_t size = o.picture.title.size(); size > most)
    fail(ErrorKind::argument, "--title of ", size, " characters, must have at most ", most);
}

/// --annotate: how many maxima, or the user's own labels.
struct PictureAddition {
  std::size_t maxima = 0;
  std::vector<Mark> labels;
};

PictureAddition read_annotation(const ImageOptions& o) {
  PictureAddition annotation;
  if (!o.annotate) return annotation;
  if (fs::path(*o.annotate).extension() == ".csv") {
    for (const Label& label : load_labels(*o.annotate))
      annotation.labels.push_back({radians(label.bearing_deg), label.range, label.text});
    return annotation;
  }
  const double count = o.annotate->empty() ? 5 : parse_number("--annotate", *o.annotate);
  if (!(count >= 1 && count <= 1000 && count == std::floor(count)))
    fail(ErrorKind::argument, "--annotate = ", *o.annotate, ", must be a number of maxima, 1 to 1000, or a .csv file");
  annotation.maxima = static_cast<std::size_t>(count);
  return annotation;
}

void draw_ping(const ImageRun& run, const ImageOptions& o, PictureOptions picture, const PictureAddition& annotation,
               std::size_t ping, const std::string& path) {
  picture.marks = annotation.labels;
  if (annotation.maxima > 0)
    picture.marks = strongest_maxima(levels_of(run, o, ping), annotation.maxima, picture.window_db);
  if (picture.title.empty()) picture.title = default_title(run, o, ping);
  view_of(o).draw({run, o, picture, ping, path});
}

InputPaths inputs_of(const ImageOptions& o) { return {o.run, o.scene, o.sonar, o.starboard}; }

/// Equal for pings whose pictures are the same.
std::string shown_by(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  if (!view_of(o).of_levels) return std::to_string(ping);
  const LevelImage image = levels_of(run, o, ping);
  Sha256 shown;
  const auto add = [&](const auto& values) {
    shown.add(
        {reinterpret_cast<const char*>(values.data()), static_cast<std::size_t>(values.size()) * sizeof values[0]});
  };
  shown.add(o.picture.title.empty() ? default_title(run, o, ping) : "");
  add(image.fan.azimuth), add(image.fan.elevation), add(image.level_db.reshaped().eval());
  add(std::array{image.gate.min_range, image.gate.bin_size});
  return shown.digest();
}

/// Draws a picture of each ping into the folder; equal ones, as of packets that a recording repeats, once.
void draw_series(const ImageRun& run, const ImageOptions& o, const PictureOptions& picture,
                 const PictureAddition& annotation, const RunDirectory& directory,
                 const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> first;
  std::vector<std::size_t> drawn;  // the ping whose picture each ping has
  for (std::size_t ping = 0; ping < names.size(); ++ping)
    drawn.push_back(first.try_emplace(shown_by(run, o, ping), ping).first->second);
  Progress progress(o.common, static_cast<int>(first.size()));
  StopWatch watch;
  for (std::size_t ping = 0; ping < names.size(); ++ping) {
    const std::string path = directory.file(names[ping]);
    if (drawn[ping] != ping) {
      write_file(path, read_text_file(directory.file(names[drawn[ping]])));
      continue;
    }
    progress.step("drawing " + names[ping]);
    draw_ping(run, o, picture, annotation, ping, path);
    constexpr double long_time = 5;  // [s]
    const double seconds = ping == 0 ? static_cast<double>(first.size()) * watch.lap() : 0;
    if (seconds > long_time && first.size() > 1)
      progress.note(fmt::format("{} pictures, which take about {}", first.size(), time_text(seconds)));
  }
}

void animate(const ImageRun& run, const ImageOptions& o, PictureOptions picture, const PictureAddition& annotation) {
  constexpr std::size_t most = 10000;
  const std::size_t pings = run.cube.pings.size();
  if (pings > most)
    fail(ErrorKind::content, o.run, ": has ", pings, " pings, --animate draws at most ", most,
         "; split it, or draw single pings by --ping");
  if (std::isnan(picture.max_db)) {
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t ping = 0; ping < pings; ++ping)
      highest = std::max(highest, view_of(o).max_db({run, o, picture, ping, ""}));
    picture.max_db = highest;
  }
  RunDirectory directory(o.output, o.force, inputs_of(o));
  std::vector<std::string> names, files;
  for (std::size_t ping = 0; ping < pings; ++ping) {
    names.push_back(fmt::format("{}_{:06}.png", o.view, ping));
    files.push_back((fs::path(o.output) / names.back()).string());
  }
  draw_series(run, o, picture, annotation, directory, names);
  write_manifest(directory,
                 {{"schema", 1}, {"insonify_version", INSONIFY_VERSION}, {"drawn", o.run}, {"view", o.view}});
  directory.commit();
  print_summary(o.common, {{"output", files}, {"view", o.view}}, fmt::format("{}", fmt::join(files, "\n")));
  Progress(o.common, 1)
      .note(fmt::format("as a film: ffmpeg -framerate 10 -i {}/{}_%06d.png -pix_fmt yuv420p {}.mp4", o.output, o.view,
                        o.view));
}

/// Refuses options that the view does not take.
void require_options_of_view(const ImageOptions& o) {
  const ImageOptions none;
  for (const ViewOption& option : options_of_views()) {
    const std::vector<std::string> takers = views_with(option.name);
    const bool given = std::visit([&](auto member) { return o.*member != none.*member; }, option.value);
    if (given && std::find(takers.begin(), takers.end(), o.view) == takers.end())
      fail(ErrorKind::argument, option.name, " goes with --view ", alternatives(takers), ", not ", o.view);
  }
}

void draw_run(const ImageOptions& o) {
  const PictureAddition annotation = read_annotation(o);
  if (!o.animate) require_free_file(o.output, o.force, inputs_of(o));
  if (const auto draw = view_of(o).draw_alone) return draw(o);
  const ImageRun run = read_image_run(o.run, o.layer);
  const std::size_t pings = run.cube.pings.size();
  if (o.ping >= pings)
    fail(ErrorKind::argument, "--ping = ", o.ping, ", must be below ", pings, ", the number of pings in ", o.run);
  if (run.side_scan && view_of(o).of_bearings)
    fail(ErrorKind::argument, "--view ", o.view, " shows beams by bearing, which the sides of a side-scan (", o.run,
         ") have not; take --view waterfall");
  if (!run.unit.empty() && view_of(o).of_phases)
    fail(ErrorKind::argument, "--view ", o.view, " shows frequencies, which the levels of a recording (", o.run,
         ") have not; take --view ascan");
  choose_beam(o, run.cube.pings.front().fan);

  if (o.animate) return animate(run, o, o.picture, annotation);
  Progress progress(o.common, 1);
  progress.step("drawing " + o.output);
  draw_ping(run, o, o.picture, annotation, o.ping, o.output);
  print_summary(o.common, {{"output", o.output}, {"view", o.view}, {"ping", o.ping}}, o.output);
}

void image(const ImageOptions& o) {
  require_options_of_view(o);
  require_drawable(o);
  for (const ImageOptions& drawn : drawn_heads(o)) draw_run(drawn);
}

}  // namespace

Verb image_verb() {
  return make_verb<ImageOptions>(
      "image", "a picture of a run, drawn without a display",
      {"insonify image out -o fan.png --annotate", "insonify image out --view ascan --beam 128 -o beam.png",
       "insonify image track --animate -o frames", "insonify image track --view waterfall --beam max -o waterfall.png",
       "insonify image out --view scene -o scene.png",
       "insonify image survey/port --starboard survey/starboard --view waterfall --altitude 5 -o side-scan.png",
       "insonify image survey/ping360 --view scan --frame world -o sweep.png",
       "insonify image survey --view track -o track.png", "insonify image survey --view bathymetry -o depths.png",
       "insonify image reef.ply --view scene --sonar p900-45 --pose=-1,4,-2.2,0,15,0 -o visibility.png"},
      add_options, image);
}

}  // namespace insonify::tool
