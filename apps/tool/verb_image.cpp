#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "store/label_table.hpp"
#include "tool/image_scene.hpp"
#include "tool/image_views.hpp"
#include "tool/progress.hpp"
#include "tool/verbs.hpp"
#include "view/strongest_maxima.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// --annotate: how many maxima, or the user's own labels.
struct Annotation {
  std::size_t maxima = 0;
  std::vector<Mark> labels;
};

Annotation read_annotation(const ImageOptions& o) {
  Annotation annotation;
  if (!o.annotate) return annotation;
  if (o.view != "fan" && o.view != "rect" && o.view != "panels")
    fail(ErrorKind::argument, "--annotate goes with --view fan, rect or panels, not ", o.view);
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
  draw_view(run, o, picture, ping, path);
}

std::string frame_path(const ImageOptions& o, std::size_t ping) {
  return (fs::path(o.output) / fmt::format("{}_{:06}.png", o.view, ping)).string();
}

/// Makes the folder of a series. Pictures of an earlier series in it are in the way, and --force removes them: what is
/// left over of a longer one would end up in the film.
void make_frame_folder(const ImageOptions& o) {
  std::error_code error;
  if (fs::exists(o.output, error) && !fs::is_directory(o.output, error))
    fail(ErrorKind::file, o.output, ": is a file, must be a folder for the pictures of --animate");
  fs::create_directory(o.output, error);
  if (error) fail(ErrorKind::file, o.output, ": cannot be made: ", error.message());
  for (std::size_t ping = 0; fs::exists(frame_path(o, ping), error); ++ping) {
    if (!o.force)
      fail(ErrorKind::file, frame_path(o, ping),
           ": exists already; give --force to replace the series, or another name");
    fs::remove(frame_path(o, ping), error);
  }
}

void animate(const ImageRun& run, const ImageOptions& o, PictureOptions picture, const Annotation& annotation,
             Progress& progress) {
  if (o.view == "waterfall") fail(ErrorKind::argument, "--animate needs one picture per ping, a waterfall shows all");
  if (o.view == "grey" || o.view == "scene") fail(ErrorKind::argument, "--animate does not go with --view ", o.view);
  if (std::isnan(picture.max_db)) picture.max_db = common_max_db(run, o, picture.window_db);
  const std::size_t pings = run.cube.pings.size();
  make_frame_folder(o);
  for (std::size_t ping = 0; ping < pings; ++ping) {
    progress.step(fmt::format("drawing {}", frame_path(o, ping)));
    draw_ping(run, o, picture, annotation, ping, frame_path(o, ping));
    fmt::print("{}\n", frame_path(o, ping));
  }
  progress.note(fmt::format("as a film: ffmpeg -framerate 10 -i {}/{}_%06d.png -pix_fmt yuv420p {}.mp4", o.output,
                            o.view, o.view));
}

}  // namespace

void image(const CommonOptions& common, const ImageOptions& o) {
  const PictureOptions picture = picture_options(o);
  const Annotation annotation = read_annotation(o);
  std::error_code ignored;
  if (!o.animate && !o.force && fs::exists(o.output, ignored))
    fail(ErrorKind::file, o.output, ": exists already; give --force to replace it, or another name");
  if (o.view != "scene") require_no_scene_options(o);
  if (o.view == "scene" && !o.animate) return image_scene(common, o, picture);
  const ImageRun run = read_image_run(o.run, o.layer);
  const std::size_t pings = run.cube.pings.size();
  if (o.ping >= pings)
    fail(ErrorKind::argument, "--ping = ", o.ping, ", must be below ", pings, ", the number of pings in ", o.run);
  choose_beam(o, run.cube.pings.front().fan.beams());

  Progress progress(common, o.animate ? static_cast<int>(pings) : 1);
  if (o.animate) return animate(run, o, picture, annotation, progress);
  progress.step("drawing " + o.output);
  draw_ping(run, o, picture, annotation, o.ping, o.output);
  fmt::print("{}\n", o.output);
}

}  // namespace insonify::tool
