// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/prepare_tiles.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "files/memory_limit.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr std::size_t batch_rows = 1 << 18;
constexpr double bytes_of_height = 250;  // memory for a point of a raster, which is completed whole

/// Facts about the file that both passes share.
struct Survey {
  RowFile file;
  ReadOptions reading;
  RawCloud whole;  // tags, box and counts; no points
  bool normals = false, areas = false, noise = false, ids_ascend = true;
  std::size_t bad_areas = 0, bad_noise = 0;
  float largest_area = 0;
  std::vector<std::size_t> label_count = std::vector<std::size_t>(no_label + 1, 0);
  bool labels = false;
  std::vector<Vector3f> sample{};  // raster_sample, relative to the first of its points [m]
  Vector3d first_of_sample = Vector3d::Zero();
  std::size_t sampled = 0;  // number of points that were considered

  /// Returns the completed fractions of both passes, which are short beside the estimation of normals.
  double passes() const { return normals ? 0.35 : 0.05; }
};

struct Batch {
  RawCloud raw;
  std::vector<Vector3d> positions;
};

Batch read_batch(const Survey& survey, std::size_t first) {
  const std::size_t count = std::min(batch_rows, survey.file.rows - first);
  const RowTable table = read_rows(survey.file, first, count);
  Batch batch;
  batch.raw.path = survey.file.path;
  batch.raw.meaning = survey.whole.meaning;
  batch.raw.tags = survey.whole.tags;
  batch.raw.points_in_file = survey.file.rows;
  fill_cloud(batch.raw, table, survey.reading);
  batch.positions = read_positions(batch.raw, table, survey.reading);
  return batch;
}

bool is_noise(float noise) { return std::isfinite(noise) && noise >= 0; }

bool bad_area(float area) { return !(std::isfinite(area) && area >= 0); }

void report_progress(const PrepareTilesOptions& options, double part) {
  if (options.progress) options.progress(part);
}

void add_to_sample(const Batch& batch, std::size_t first, Survey& survey) {
  for (std::size_t row; (row = raster_sample(survey.sampled, survey.file.rows)) < first + batch.positions.size();
       ++survey.sampled) {
    const Vector3d& position = batch.positions[row - first];
    if (!position.allFinite()) continue;
    if (survey.sample.empty()) survey.first_of_sample = position;
    survey.sample.push_back((position - survey.first_of_sample).cast<float>());
  }
}

/// Finds the bounding box, the labels and the columns present, in the first pass.
void survey_rows(Survey& survey, const PrepareTilesOptions& options) {
  RawCloud& whole = survey.whole;
  std::int64_t last_id = -1;
  for (std::size_t first = 0; first < survey.file.rows; first += batch_rows) {
    const Batch batch = read_batch(survey, first);
    const RawCloud& raw = batch.raw;
    add_counts(whole, raw);
    add_to_sample(batch, first, survey);
    whole.float_coordinates = raw.float_coordinates;
    whole.meaning = raw.meaning;
    whole.named_depth = raw.named_depth;
    whole.label_field = raw.label_field;
    whole.other_columns = raw.other_columns;
    survey.normals = !raw.normal.empty();
    survey.areas = !raw.area.empty();
    survey.noise = !raw.noise.empty();
    survey.labels = !raw.label.empty();
    survey.bad_areas += static_cast<std::size_t>(std::count_if(raw.area.begin(), raw.area.end(), bad_area));
    survey.bad_noise += static_cast<std::size_t>(
        std::count_if(raw.noise.begin(), raw.noise.end(), [](float noise) { return !is_noise(noise); }));
    for (const float area : raw.area)
      if (std::isfinite(area)) survey.largest_area = std::max(survey.largest_area, area);
    for (std::size_t i = 0; i < raw.label.size(); ++i)
      if (raw.point[i].allFinite()) ++survey.label_count[raw.label[i]];
    survey.ids_ascend = survey.ids_ascend && !raw.id.empty();
    for (const std::uint32_t id : raw.id) {
      survey.ids_ascend = survey.ids_ascend && id > last_id;
      last_id = id;
    }
    report_progress(options,
                    0.4 * survey.passes() * static_cast<double>(first) / static_cast<double>(survey.file.rows));
  }
  resolve_meaning(whole);
  require_usable_points(whole, survey.file.rows);
  if (survey.largest_area > largest_area(whole)) ++survey.bad_areas;
}

std::vector<std::uint16_t> plan_materials(const Survey& survey, const LoadOptions& options, LoadedScene& result) {
  // Complete the materials with one surfel per label that occurs.
  std::vector<std::uint16_t> labels;
  for (std::size_t label = 0; label < survey.label_count.size(); ++label)
    if (survey.label_count[label] > 0) labels.push_back(static_cast<std::uint16_t>(label));
  result.scene.material = labels;
  result.scene.point.resize(std::max<std::size_t>(1, labels.size()));
  complete_materials(survey.whole, options, result);
  std::vector<std::uint16_t> index(survey.label_count.size(), result.scene.material.front());
  for (std::size_t k = 0; k < labels.size(); ++k) index[labels[k]] = result.scene.material[k];
  if (result.report.outside_intervals > 0) {
    result.report.outside_intervals = survey.label_count[no_label];
    result.report.notes.back() = share(result.report.outside_intervals, survey.file.rows, "points") + " have a '" +
                                 survey.whole.label_field +
                                 "' in none of the intervals: their Lambert coefficient is the default, -27 dB";
  }
  return index;
}

/// Returns the usable surfels of a batch, and counts the dropped ones. Missing normals look up until they are known.
SceneCloud surfels_of(Batch& batch, std::size_t first, const Survey& survey, const std::vector<std::uint16_t>& material,
                      std::vector<Vector3d>& positions, LoadedScene& result) {
  RawCloud& raw = batch.raw;
  if (!survey.normals) raw.normal.assign(raw.point.size(), Vector3f::UnitZ());
  renormalise(raw.normal, survey.whole.tags.prepared);
  const bool turn = survey.normals && !survey.whole.tags.oriented && survey.whole.viewpoint;
  const Vector3d viewpoint = survey.whole.viewpoint.value_or(Vector3d::Zero()) - *survey.reading.origin;
  SceneCloud scene;
  scene.materials = result.scene.materials;
  positions.clear();
  for (std::size_t i = 0; i < raw.point.size(); ++i) {
    if (!raw.point[i].allFinite()) continue;
    if (!usable_normal(raw.normal[i])) {
      ++result.report.dropped_without_normal;
      continue;
    }
    const bool away = turn && raw.normal[i].cast<double>().dot(viewpoint - batch.positions[i]) < 0;
    positions.push_back(batch.positions[i]);
    scene.point.push_back(raw.point[i]);
    scene.normal.push_back(away ? Vector3f(-raw.normal[i]) : raw.normal[i]);
    scene.area.push_back(result.report.areas_estimated ? 0 : raw.area[i]);
    scene.material.push_back(material[survey.labels ? raw.label[i] : 0]);
    if (!raw.noise.empty()) scene.noise.push_back(is_noise(raw.noise[i]) ? raw.noise[i] : 0);
    scene.id.push_back(survey.ids_ascend ? raw.id[i] : static_cast<std::uint32_t>(first + i));
  }
  return scene;
}

/// Throws Error(content) if a raster of heights without normals, which is completed whole, is larger than memory.
void require_memory_for_raster(const Survey& survey) {
  const double needed = bytes_of_height * static_cast<double>(survey.file.rows), gib = 1 << 30;
  if (needed > available_memory())
    fail(ErrorKind::content, survey.file.path, ": is a raster of ", survey.file.rows,
         " heights without normals, which takes some ", std::ceil(needed / gib),
         " GiB of memory; divide it, or add normals to the file");
}

/// Returns the report of the reading of all rows.
LoadReport report_of(const Survey& survey, const LoadOptions& options) {
  const RawCloud& whole = survey.whole;
  LoadReport report = begin_report(whole);
  report.areas_estimated = !survey.areas || survey.bad_areas > 0;
  report.normals_estimated = !survey.normals;
  report.noise_estimated = !survey.normals && !survey.noise && !options.scan_noise;
  if (report.normals_estimated) report.viewpoint = whole.viewpoint;
  if (report.normals_estimated && !whole.viewpoint) report.notes.emplace_back(two_sided_note);
  if (survey.bad_areas > 0)
    report.notes.push_back("at least " + share(survey.bad_areas, survey.file.rows, "areas") +
                           " were negative, NaN or larger than the cloud: all were estimated");
  if (survey.bad_noise > 0) report.notes.push_back(bad_noise_note(survey.bad_noise, survey.file.rows));
  if (!survey.ids_ascend && (column_named(survey.file.columns, "id") || column_named(survey.file.columns, "scalar_id")))
    report.notes.push_back("the ids in the file do not ascend: renumbered by row");
  return report;
}

TileWriterOptions writer_options(const Survey& survey, const LoadedScene& result, const PrepareTilesOptions& options) {
  const RawCloud& whole = survey.whole;
  const LoadReport& report = result.report;
  TileWriterOptions writing;
  writing.origin = whole.origin;
  writing.materials = result.scene.materials;
  writing.system = whole.meaning.system.value;
  writing.normals_oriented = (survey.normals && whole.tags.oriented) || whole.viewpoint.has_value();
  writing.drop_duplicates = !whole.tags.prepared;
  writing.memory = options.memory;
  writing.threads = options.load.threads;
  writing.progress = [&](double part) { report_progress(options, survey.passes() + (1 - survey.passes()) * part); };
  if (report.normals_estimated)
    writing.complete = [how = GroupCompletion{options.load, whole.origin, whole.viewpoint, report.areas_estimated,
                                              report.noise_estimated}](SceneCloud& group) {
      complete_group(how, group);
    };
  else if (report.areas_estimated)
    writing.complete = [threads = options.load.threads](SceneCloud& group) {
      group.area = estimate_surfel_areas(group.point, group.normal, {.threads = threads});
    };
  return writing;
}

/// Writes the tiles of a file in batches; nothing if it may be a raster of heights without normals, whose side only
/// the whole shows.
std::optional<PreparedTiles> stream(RowFile file, const std::string& output, const PrepareTilesOptions& options) {
  Survey survey{std::move(file), read_options(options.load), {}};
  RawCloud& whole = survey.whole = raw_of(survey.file);
  whole.meaning.override_by(options.load.meaning);
  if (survey.reading.material_field.name.empty()) survey.reading.material_field.name = whole.tags.material_field;
  survey.reading.origin = Vector3d::Zero();
  survey_rows(survey, options);
  if (!survey.normals && may_be_raster(survey.sample, survey.file.rows)) {
    require_memory_for_raster(survey);
    return std::nullopt;
  }
  survey.reading.origin = whole.origin = origin_of(whole);
  if (whole.viewpoint) whole.viewpoint = whole.meaning.axes().position(*whole.viewpoint);
  if (options.load.viewpoint) whole.viewpoint = options.load.viewpoint;

  LoadedScene result;
  LoadReport& report = result.report = report_of(survey, options.load);
  const std::vector<std::uint16_t> material = plan_materials(survey, options.load, result);
  TileWriter writer(output, writer_options(survey, result, options));
  std::vector<Vector3d> positions;
  for (std::size_t first = 0; first < survey.file.rows; first += batch_rows) {
    Batch batch = read_batch(survey, first);
    SceneCloud scene = surfels_of(batch, first, survey, material, positions, result);
    if (scene.noise.empty() && (report.noise_estimated || options.load.scan_noise))
      scene.noise.assign(scene.size(), static_cast<float>(options.load.scan_noise.value_or(0)));
    writer.add(scene, positions);
    report_progress(options,
                    survey.passes() * (0.4 + 0.6 * static_cast<double>(first) / static_cast<double>(survey.file.rows)));
  }
  const bool oriented = (survey.normals && whole.tags.oriented) || whole.viewpoint.has_value();
  PreparedTiles prepared{{}, writer.finish(), oriented, true};
  report.dropped_duplicates = prepared.tiles.dropped_duplicates;
  note_no_area(prepared.tiles.total_area, report.notes);
  const double spacing =
      std::sqrt(prepared.tiles.total_area / std::max(1.0, static_cast<double>(prepared.tiles.surfels)));
  if (!whole.tags.prepared)
    for (std::string& doubt : doubts_about(whole, spacing)) report.notes.push_back(std::move(doubt));
  prepared.report = report;
  return prepared;
}

/// Returns the surfels of a file that is read whole. Tiles hold no surface between the points of a height field.
LoadedScene load_surfels(const SceneReader& reader, const std::string& path, const LoadOptions& options) {
  if (reader.load) return reader.load(path, options);
  RawCloud raw = reader.read(path, read_options(options));
  raw.only_surfels = options.mesh_spacing == 0;
  return complete_scene(std::move(raw), options);
}

}  // namespace

PreparedTiles prepare_tiles(const std::string& path, const std::string& output, const PrepareTilesOptions& options) {
  check_options(options.load, "prepare_tiles");
  const SceneReader& reader = reader_of(path);
  std::optional<RowFile> rows = reader.find_rows ? reader.find_rows(path) : std::nullopt;
  if (rows && rows->rows > options.whole_points) {
    if (std::optional<PreparedTiles> prepared = stream(std::move(*rows), output, options)) {
      const TiledScene readable(output);
      return std::move(*prepared);
    }
  }
  LoadedScene loaded = load_surfels(reader, path, options.load);
  TileWriterOptions writing;
  writing.memory = options.memory;
  writing.threads = options.load.threads;
  writing.progress = options.progress;
  writing.system = loaded.report.meaning.system.value;
  const TileReport tiles = save_tiles(output, loaded.scene, writing);
  const TiledScene readable(output);
  return {loaded.report, tiles, loaded.scene.normals_oriented, false};
}

}  // namespace insonify
