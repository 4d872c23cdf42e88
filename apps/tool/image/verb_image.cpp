#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "store/csv_tables.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/dataset/label_pictures.hpp"
#include "tool/image/image.hpp"
#include "tool/run/run_checks.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// The options of view scene, which stand in a group of their own.
void add_scene_view(OptionList list, ImageOptions& o) {
  const char* group = "Of view scene";
  list.add("--scene", &o.scene, "the run's scene, if it is not where run.toml says", {.group = group});
  list.add("--sonar", &o.sonar, "to inspect a scene: preset, .toml file, or run.toml of a run", {.group = group});
  list.add("--pose", &o.pose, "to inspect a scene: x,y,z,yaw,pitch,roll [m, deg]", {.group = group});
  list.add("--range", &o.range, "to inspect a scene: MIN:MAX [m]; default: to the end of the scene", {.group = group});
  list.add("--world", &o.world, "z-up or ned", {.words = {"z-up", "ned"}, .group = group});
  list.add("--camera", &o.camera, "auto, behind (the head), top, side or iso",
           {.words = words_of(camera_words), .group = group});
  list.add("--normals", &o.normals, "draw some 4000 normals as lines", {.group = group});
  list.add("--colour", &o.colour, "height, material, visibility, level, grazing or incidence; default: what suits",
           {.words = words_of(colour_words), .group = group});
}

void add_options(OptionList list, ImageOptions& o) {
  std::vector<std::string> names, views;
  for (const ViewSpec& view : all_views()) {
    names.emplace_back(view.name);
    views.push_back(fmt::format("{}: {}", view.name, view.shows));
  }
  list.add("RUN", &o.run, "run directory or cube.h5; for view scene also a cloud or mesh", {.required = true});
  list.add("-o,--output", &o.output, "picture to write, .png (grey also .pgm); with --animate a folder",
           {.required = true});
  list.add("--view", &o.view, joined(views, "; "), {.words = names});
  list.add("--bits", &o.bits, "of grey: 8 or 16", {.words = {"8", "16"}, .shown_as = "INT"});
  list.add("--frame", &o.frame, "of scan: head, as an operator sees it, or world: the vehicle's motion compensated",
           {.words = {"head", "world"}});
  list.add("--min-level", &o.min_level, std::string("of labels: ") + min_level_help);
  list.add("--starboard", &o.starboard, "of waterfall: the run of the starboard head, RUN being the port one");
  list.add("--altitude", &o.altitude, "[m] of waterfall: ground range on a flat bottom so far below the head");
  list.add("--bottom", &o.bottom, "[m] of waterfall: the same, with the bottom at this z and the head at its pose",
           {.excludes = "--altitude"});
  list.add("--layer", &o.layer, "one kind of echo alone, e.g. multipath, of a run made with --layers");
  list.add("--ping", &o.ping, "which ping, from 0");
  list.add("--beam", &o.beam, "from 0, max (waterfall) or all (spectrum); default: the middle one, of a spectrum all");
  list.add("--raw", &o.raw, "levels as received; default: range compensated; excludes --tvg", {.shown_as = " "});
  list.add("--tvg", &o.tvg, "[dB per decade of range] given back, with absorption; 40: a point's, 30: a bottom's",
           {.excludes = "--raw", .shown_as = "FLOAT"});
  list.add("--window", &o.window_db, "[dB] from darkest to brightest");
  list.add("--max", &o.max_db, "[dB] brightest level; default: automatic");
  list.add("--colormap", &o.colour_map, joined(colour_map_names()), {.words = colour_map_names()});
  list.add("--size", &o.size, "WIDTHxHEIGHT [pixels]; default: 1400x1050, of fans as much of it as they fill");
  list.add("--title", &o.title, "default: sonar and ping");
  list.add("--dark", &o.dark, "dark background");
  list.add("--annotate", &o.annotate,
           "name so many of the strongest maxima (5), or the places in a .csv: bearing_deg,range_m,text",
           {.shown_as = "[N|CSV]"});
  list.add("--animate", &o.animate, "one picture per ping in the folder -o, all with the same levels");
  list.add("--force", &o.force, "replace existing pictures");
  add_scene_view(list, o);
  add_common(list, o.common);
}

/// Throws Error(argument) for a title that no picture has room for.
void require_title(const std::string& title) {
  constexpr std::size_t most = 1000;
  if (title.size() > most)
    fail(ErrorKind::argument, "--title of ", title.size(), " characters, must have at most ", most);
}

/// --annotate: how many maxima, or the user's own labels.
struct Annotation {
  std::size_t maxima = 0;
  std::vector<Mark> labels;
};

Annotation read_annotation(const ImageOptions& o) {
  Annotation annotation;
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

/// Draws one ping with its marks.
void draw_ping(const ImageRun& run, const ImageOptions& o, PictureOptions picture, const Annotation& annotation,
               std::size_t ping, const std::string& path) {
  picture.marks = annotation.labels;
  if (annotation.maxima > 0)
    picture.marks = strongest_maxima(levels_of(run, o, ping), annotation.maxima, picture.window_db);
  picture.title = o.title.empty() ? default_title(run, o, ping) : o.title;
  view_of(o).draw({run, o, picture, ping, path});
}

InputPaths inputs_of(const ImageOptions& o) { return {o.run, o.scene, o.sonar, o.starboard}; }

void animate(const ImageRun& run, const ImageOptions& o, PictureOptions picture, const Annotation& annotation,
             Progress& progress) {
  const std::size_t pings = run.cube.pings.size();
  if (std::isnan(picture.max_db)) {
    picture.max_db = view_of(o).max_db(run, o, 0);
    for (std::size_t ping = 1; ping < pings; ++ping)
      picture.max_db = std::max(picture.max_db, view_of(o).max_db(run, o, ping));
  }
  RunDirectory directory(o.output, o.force, inputs_of(o));
  std::vector<std::string> files;
  for (std::size_t ping = 0; ping < pings; ++ping) {
    const std::string name = fmt::format("{}_{:06}.png", o.view, ping);
    files.push_back((fs::path(o.output) / name).string());
    progress.step("drawing " + files.back());
    draw_ping(run, o, picture, annotation, ping, directory.file(name));
  }
  write_manifest(directory,
                 {{"schema", 1}, {"insonify_version", INSONIFY_VERSION}, {"drawn", o.run}, {"view", o.view}});
  directory.commit();
  print_summary(o.common, {{"output", files}, {"view", o.view}}, fmt::format("{}", fmt::join(files, "\n")));
  progress.note(fmt::format("as a film: ffmpeg -framerate 10 -i {}/{}_%06d.png -pix_fmt yuv420p {}.mp4", o.output,
                            o.view, o.view));
}

/// Refuses options that the view does not take.
void require_options_of_view(const ImageOptions& o) {
  const std::pair<const char*, bool> given[] = {{"--annotate", o.annotate.has_value()},
                                                {"--animate", o.animate},
                                                {"--scene", !o.scene.empty()},
                                                {"--sonar", !o.sonar.empty()},
                                                {"--pose", !o.pose.empty()},
                                                {"--range", !o.range.empty()},
                                                {"--camera", o.camera != "auto"},
                                                {"--colour", !o.colour.empty()},
                                                {"--normals", o.normals},
                                                {"--frame", o.frame != "head"},
                                                {"--min-level", !o.min_level.empty()},
                                                {"--starboard", !o.starboard.empty()},
                                                {"--altitude", !o.altitude.empty()},
                                                {"--bottom", !o.bottom.empty()}};
  const std::vector<std::string>& taken = view_of(o).options;
  for (const auto& [option, is_given] : given)
    if (is_given && std::find(taken.begin(), taken.end(), option) == taken.end())
      fail(ErrorKind::argument, option, " goes with --view ", views_with(option), ", not ", o.view);
}

void image(const ImageOptions& o) {
  require_options_of_view(o);
  const PictureOptions picture = picture_options(o);
  require_title(o.title);
  const Annotation annotation = read_annotation(o);
  if (!o.animate) require_free_file(o.output, o.force, inputs_of(o));
  if (const auto draw = view_of(o).draw_alone) return draw(o, picture);
  const ImageRun run = read_image_run(o.run, o.layer);
  const std::size_t pings = run.cube.pings.size();
  if (o.ping >= pings)
    fail(ErrorKind::argument, "--ping = ", o.ping, ", must be below ", pings, ", the number of pings in ", o.run);
  choose_beam(o, run.cube.pings.front().fan);

  Progress progress(o.common, o.animate ? static_cast<int>(pings) : 1);
  if (o.animate) return animate(run, o, picture, annotation, progress);
  progress.step("drawing " + o.output);
  draw_ping(run, o, picture, annotation, o.ping, o.output);
  print_summary(o.common, {{"output", o.output}, {"view", o.view}, {"ping", o.ping}}, o.output);
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
       "insonify image survey --view track -o track.png",
       "insonify image reef.ply --view scene --sonar p900-45 --pose=-1,4,-2.2,0,15,0 -o visibility.png"},
      add_options, image);
}

}  // namespace insonify::tool
