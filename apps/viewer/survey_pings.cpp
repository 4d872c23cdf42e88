// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "returns/sounding_columns.hpp"
#include "scene_io/load_scene.hpp"
#include "store/cube.hpp"
#include "store/survey_run.hpp"
#include "view/ping_record.hpp"
#include "viewer/viewer_command.hpp"

namespace insonify::viewer {
namespace {

namespace fs = std::filesystem;

struct CubeList {
  std::vector<CubeOfPings> cubes;
  std::vector<std::size_t> begin;  // of each cube in the list; and the end of all
  std::vector<std::int64_t> number;
  Soundings returns;  // of one cube
  std::size_t returns_of = std::numeric_limits<std::size_t>::max();

  std::size_t cube_of(std::size_t ping) const {
    return static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), ping) - begin.begin()) - 1;
  }

  ComplexGridF beam(std::size_t first, std::size_t count, std::size_t beam) const {
    ComplexGridF rows;
    for (std::size_t done = 0; done < count;) {
      const std::size_t at = first + done, c = cube_of(at);
      const std::size_t here = std::min(count - done, begin[c + 1] - at);
      const ComplexGridF part = read_beam(cubes[c].cube, at - begin[c], here, beam);
      if (done == 0) rows.resize(static_cast<Eigen::Index>(count), part.cols());
      rows.middleRows(static_cast<Eigen::Index>(done), part.rows()) = part;
      done += here;
    }
    return rows;
  }

  Soundings returns_of_ping(std::size_t ping) {
    const std::size_t c = cube_of(ping);
    if (c != returns_of) returns = path_exists(cubes[c].returns) ? load_soundings(cubes[c].returns) : Soundings{};
    returns_of = c;
    return soundings_of_ping(returns, number[ping], {});
  }
};

template <typename Values>
void add_rows(Values& to, const Values& more) {
  const Values before = to;
  to.resize(before.rows() + more.rows(), before.cols());
  to << before, more;
}

}  // namespace

LazyPings lazy_pings_of(const std::vector<CubeOfPings>& cubes) {
  const auto list = std::make_shared<CubeList>();
  list->cubes = cubes;
  std::vector<TrackPoint> positions;
  for (const CubeOfPings& cube : cubes) {
    list->begin.push_back(positions.size());
    for (const TrackPoint& point : read_track(cube.cube)) {
      positions.push_back(point);
      list->number.push_back(point.number);
    }
  }
  list->begin.push_back(positions.size());
  PingSource source;
  source.ping = [list](std::size_t i) {
    const std::size_t c = list->cube_of(i);
    return std::move(read_cube(list->cubes[c].cube, i - list->begin[c], 1).pings.at(0));
  };
  source.beam = [list](std::size_t first, std::size_t count, std::size_t beam) {
    return list->beam(first, count, beam);
  };
  if (std::any_of(cubes.begin(), cubes.end(), [](const CubeOfPings& cube) { return !cube.returns.empty(); }))
    source.returns = [list](std::size_t i) { return list->returns_of_ping(i); };
  return {std::move(positions), std::move(source)};
}

std::optional<LazyPings> lazy_pings_of_sides(const LazyPings& port, const LazyPings& starboard) {
  constexpr double most_growth = 16;  // ratio of cells of a waterfall that begins at the head to cells of one side
  const RangeGate& gate = port.gate();
  if (port.fan().beams() != 1 || starboard.fan().beams() != 1 || !(gate == starboard.gate())) return {};
  if (gate.max_range > most_growth * (gate.max_range - gate.min_range)) return {};
  const Eigen::AngleAxisd ahead(-pi / 2, Eigen::Vector3d::UnitZ());  // from the axis of the port head
  std::vector<TrackPoint> positions = port.positions();
  positions.resize(std::min(port.size(), starboard.size()));
  for (TrackPoint& position : positions) position.world_from_head = position.world_from_head * ahead;
  PingSource source;
  source.ping = [port, starboard, ahead](std::size_t i) {
    Ping both = *port.ping(i);
    const std::shared_ptr<const Ping> other = starboard.ping(i);
    both.world_from_head = both.world_from_head * ahead;
    both.fan.azimuth[0] += pi / 2;
    const auto [azimuth, elevation] =
        direction_of(Eigen::Vector3d(both.world_from_head.linear().transpose() * other->world_from_head.linear() *
                                     unit_vector({other->fan.azimuth[0], other->fan.elevation[0]})));
    both.fan.azimuth.push_back(azimuth), both.fan.elevation.push_back(elevation);
    add_rows(both.pressure, other->pressure), add_rows(both.intensity, other->intensity);
    both.layers.clear(), both.unknown.resize(0, 0), both.split_phase.resize(0, 0), both.labels = {};
    return both;
  };
  source.beam = [port, starboard](std::size_t first, std::size_t count, std::size_t beam) {
    return (beam == 0 ? port : starboard).beam(first, count, 0);
  };
  if (port.has_returns() && starboard.has_returns())
    source.returns = [port, starboard](std::size_t i) {
      Soundings both = port.returns(i);
      const Soundings other = starboard.returns(i);
      for (std::size_t k = 0; k < other.size(); ++k) {
        append_row(both, other, k);
        both.ping.back() = static_cast<decltype(both.ping)::value_type>(port.position(i).number);
        both.beam.back() = 1;
      }
      return both;
    };
  return LazyPings(std::move(positions), std::move(source));
}

LazyPings lazy_pings_of(std::shared_ptr<const tool::SwathPings> swath) {
  std::vector<TrackPoint> positions;
  for (std::size_t i = 0; i < swath->record().pings.size(); ++i) positions.push_back(swath->track_point(i));
  PingSource source;
  source.ping = [swath](std::size_t i) { return swath->ping(i); };
  source.beam = [swath](std::size_t first, std::size_t count, std::size_t beam) {
    ComplexGridF rows;
    for (std::size_t k = 0; k < count; ++k) {
      const Ping ping = swath->ping(first + k);
      if (k == 0) rows.resize(static_cast<Eigen::Index>(count), ping.pressure.cols());
      rows.row(static_cast<Eigen::Index>(k)) = ping.pressure.row(static_cast<Eigen::Index>(beam));
    }
    return rows;
  };
  return {std::move(positions), std::move(source)};
}

LazyPings lazy_pings_of(std::vector<Ping> pings) {
  std::vector<TrackPoint> positions(pings.begin(), pings.end());
  const auto all = std::make_shared<const std::vector<Ping>>(std::move(pings));
  PingSource source;
  source.ping = [all](std::size_t i) { return all->at(i); };
  source.beam = [all](std::size_t first, std::size_t count, std::size_t beam) {
    ComplexGridF rows(static_cast<Eigen::Index>(count), all->at(first).pressure.cols());
    for (std::size_t k = 0; k < count; ++k)
      rows.row(static_cast<Eigen::Index>(k)) = all->at(first + k).pressure.row(static_cast<Eigen::Index>(beam));
    return rows;
  };
  return {std::move(positions), std::move(source)};
}

std::optional<SurveyHeadRun> find_survey_head(const std::string& target, const std::string& head) {
  const fs::path given = fs::path(target).has_filename() ? fs::path(target) : fs::path(target).parent_path();
  const bool is_whole = is_survey_run(given.string());
  const fs::path folder = is_whole ? given : given.parent_path();
  if (!is_whole && (!is_folder(given) || !is_survey_run(folder.string()))) return {};
  const SurveyRun run = load_survey_run(folder.string());
  const std::string wanted = is_whole ? head : given.filename().string();
  SurveyHeadRun found;
  const SurveyRunHead* chosen = nullptr;
  for (const SurveyRunHead& one : run.heads) {
    if (!chosen && (wanted.empty() || one.name == wanted))
      chosen = &one;
    else
      found.others.push_back(one.name);
  }
  if (!chosen)
    fail(ErrorKind::argument, "--head = '", wanted, "' is not in ", folder.string(), "; it has ",
         shortened_list(found.others));
  found.name = chosen->name;
  found.folder = (folder / chosen->name).string();
  found.blocks = chosen->blocks();
  for (const auto& [number, files, mark] : stored_blocks(folder.string(), run, *chosen)) {
    ++found.done;
    if (!mark.cube_sha256.empty()) found.cubes.push_back({files.cube, files.returns});
  }
  const fs::path merged = fs::path(found.folder) / "cube.h5";
  if (found.cubes.empty() && path_exists(merged)) {
    found.cubes.push_back({merged.string(), ""});
    found.done = found.blocks;
  }
  if (found.cubes.empty())
    fail(ErrorKind::content, found.folder, ": no ping is done yet; run the survey, or wait for its first block");
  return found;
}

}  // namespace insonify::viewer
