// SPDX-License-Identifier: BSD-3-Clause
// Opens recordings, and chooses what a view begins with.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/message.hpp"
#include "run/parse_values.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/swath_pings.hpp"
#include "viewer/viewer_command.hpp"

namespace insonify::viewer {
namespace {

// The strongest sample of a beam, range compensated (E20), which is the most prominent in the picture.
PixelPosition loudest_of(const ViewerData& data, std::size_t ping_index, std::size_t beam) {
  const auto ping = data.pings.ping(ping_index);
  const Grid<float> level = range_compensated_level_db(*ping, ping->absorption_db_per_m);
  Eigen::Index bin = 0;
  level.row(static_cast<Eigen::Index>(beam)).maxCoeff(&bin);
  return {beam, static_cast<std::size_t>(bin)};
}

// The channel that --head names, of a side-scan, whose beams are its channels.
std::size_t channel_of(const ViewerCommand& command, const tool::Record& record) {
  if (command.head.empty()) return 0;
  const auto named = std::find(record.channels.begin(), record.channels.end(), command.head);
  if (named == record.channels.end())
    fail(ErrorKind::argument, "--head = '", command.head, "' must name a channel of ", command.target, ": ",
         shortened_list(record.channels));
  return static_cast<std::size_t>(named - record.channels.begin());
}

// A swath is shown with the soundings of all pings.
LoadedView load_swath(const ViewerCommand& command) {
  if (!command.head.empty())
    fail(ErrorKind::argument, "--head = '", command.head, "': ", command.target, " is no side-scan; leave --head out");
  LoadedView view{{}, command.start, {}};
  const auto swath = std::make_shared<const tool::SwathPings>(read_swath(command.target));
  view.data.title = swath->record().format, view.data.recorded_unit = swath->unit();
  view.data.returns = swath->soundings();
  view.data.depth_datum = "below the datum";
  view.data.pings = lazy_pings_of(swath);
  view.start.tvg = false;
  choose_start(command, view);
  return view;
}

}  // namespace

LoadedView load_record(const ViewerCommand& command) {
  if (is_swath(command.target)) return load_swath(command);
  LoadedView view{{}, command.start, {}};
  tool::Record record = tool::read_record(command.target);
  view.data.title = record.kind;
  view.data.recorded_unit = record.unit;
  const auto port_and_starboard = [&] {
    const std::vector<double>& azimuth = record.cube.pings.front().fan.azimuth;
    return azimuth.size() == 2 && azimuth[0] > 0 && azimuth[1] < 0;
  };
  if (record.side_scan && command.head.empty() && port_and_starboard()) {
    view.data.sides = true;
  } else if (record.side_scan) {
    const std::size_t channel = channel_of(command, record);
    view.data.title = record.channels[channel] + ", " + view.data.title;
    if (record.channels.size() > 1 && command.head.empty())
      view.notes.push_back("the recording has the channels " + shortened_list(record.channels) +
                           ": choose with --head");
    for (Ping& ping : record.cube.pings) ping = tool::channel_alone(ping, channel);
  } else if (!command.head.empty()) {
    fail(ErrorKind::argument, "--head = '", command.head, "': ", command.target, " is no side-scan; leave --head out");
  }
  view.data.pings = lazy_pings_of(std::move(record.cube.pings));
  view.start.tvg = false;
  choose_start(command, view);
  return view;
}

void choose_start(const ViewerCommand& command, LoadedView& view) {
  const ViewerExtent extent = extent_of(view.data);
  ViewerState& start = view.start;
  if (start.ping >= extent.pings)
    fail(ErrorKind::argument, "--ping = ", start.ping, ", must be below ", extent.pings, ", the number of pings in ",
         command.target);
  if (!command.beam.empty()) {
    const double beam = parse_number("--beam", command.beam);
    if (!(beam >= 0 && beam < static_cast<double>(extent.beams) && beam == std::floor(beam)))
      fail(ErrorKind::argument, "--beam = ", command.beam, ", must be a whole number below ", extent.beams,
           ", the number of beams");
    start.selected = loudest_of(view.data, start.ping, static_cast<std::size_t>(beam));
  }
  const std::shared_ptr<const SceneCloud> scene = scene_at(view.data, start.ping);
  if (scene->materials.size() > 1) start.scene_colour = SceneColour::material;
  if (scene->parts.size() > 1) start.scene_colour = SceneColour::part;
}

}  // namespace insonify::viewer
