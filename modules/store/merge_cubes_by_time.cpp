// SPDX-License-Identifier: BSD-3-Clause
#include "store/merge_cubes_by_time.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"

namespace insonify {
namespace {

// Throws Error(content) for cubes of different sonars, fans, gates or pulses. Water may differ from ping to ping.
void require_alike(const NamedCube& one, const NamedCube& first) {
  const auto refuse = [&](const auto&... difference) {
    fail(ErrorKind::content, one.name, ": ", difference..., " in ", first.name,
         "; only pings of one sonar, fan and gate can be merged");
  };
  const Cube &a = one.cube, &b = first.cube;
  const BeamFan &fan = a.pings.front().fan, &first_fan = b.pings.front().fan;
  const RangeGate &gate = a.pings.front().gate, &first_gate = b.pings.front().gate;
  if (a.sonar != b.sonar) refuse("is of sonar ", a.sonar, ", not ", b.sonar, " as");
  if (fan.beams() != first_fan.beams()) refuse("has ", fan.beams(), " beams, not ", first_fan.beams(), " as");
  if (fan.azimuth != first_fan.azimuth || fan.elevation != first_fan.elevation ||
      fan.beam_width != first_fan.beam_width || fan.elevation_width != first_fan.elevation_width ||
      fan.row_width != first_fan.row_width)
    refuse("has beams of other directions or widths than");
  if (gate.min_range != first_gate.min_range || gate.max_range != first_gate.max_range ||
      gate.bin_size != first_gate.bin_size)
    refuse("has ranges ", gate.min_range, " to ", gate.max_range, " m in bins of ", gate.bin_size, " m, not ",
           first_gate.min_range, " to ", first_gate.max_range, " m in bins of ", first_gate.bin_size, " m as");
  if (a.centre_frequency != b.centre_frequency || a.bandwidth != b.bandwidth)
    refuse("has a pulse of ", a.centre_frequency, " Hz and ", a.bandwidth, " Hz wide, not ", b.centre_frequency,
           " and ", b.bandwidth, " Hz as");
}

std::vector<std::string> layer_names(const Ping& ping) {
  std::vector<std::string> names;
  for (const Layer& layer : ping.layers) names.push_back(layer.name);
  return names;
}

void count_up_unless_unique(std::vector<Ping>& pings) {
  std::set<std::int64_t> numbers;
  for (const Ping& ping : pings) numbers.insert(ping.number);
  if (numbers.size() == pings.size()) return;
  for (std::size_t p = 0; p < pings.size(); ++p) pings[p].number = static_cast<std::int64_t>(p);
}

/// Drops the layers, maps and labels that not all pings have alike.
void drop_unlike_parts(std::vector<Ping>& pings) {
  const auto drop_unless = [&](const auto& has, const auto& drop) {
    const auto like_first = [&](const Ping& ping) { return has(ping) == has(pings.front()); };
    if (!std::all_of(pings.begin(), pings.end(), like_first)) std::for_each(pings.begin(), pings.end(), drop);
  };
  drop_unless(layer_names, [](Ping& ping) { ping.layers.clear(); });
  const auto drop_map = [&](auto map) {
    drop_unless([map](const Ping& ping) { return (ping.*map).size() > 0; },
                [map](Ping& ping) { (ping.*map).resize(0, 0); });
  };
  drop_map(&Ping::intensity);
  drop_map(&Ping::unknown);
  drop_map(&Ping::split_phase);
  // Numbers of materials and parts mean the same in all pings only if their names do.
  drop_unless(
      [](const Ping& ping) {
        const PixelLabels& l = ping.labels;
        const std::vector<std::string> kind{l.second.size() > 0 ? "of cells" : "of samples"};
        return l.empty() ? std::vector<std::vector<std::string>>{}
                         : std::vector{l.names, l.part_names, l.part_labels, kind};
      },
      [](Ping& ping) { ping.labels = {}; });
}

/// Returns the notes of all cubes, with the numbers that their first pings have in the merged cube.
std::vector<PingNote> merged_notes(std::vector<std::vector<PingNote>> of_cubes, const MergedCube& merged) {
  std::vector<PingNote> all;
  for (std::size_t c = 0; c < of_cubes.size(); ++c) {
    for (PingNote& note : of_cubes[c])
      for (std::size_t p = 0; p < merged.origins.size(); ++p)
        if (merged.origins[p].cube == c && merged.origins[p].number == note.first) {
          note.first = merged.cube.pings[p].number;
          break;
        }
    gather(all, of_cubes[c]);
  }
  return all;
}

}  // namespace

MergedCube merge_cubes_by_time(std::vector<NamedCube> cubes) {
  if (cubes.empty()) fail(ErrorKind::argument, "merge_cubes_by_time: no cubes, must be at least one");
  for (const NamedCube& one : cubes) {
    if (one.cube.pings.empty()) fail(ErrorKind::content, one.name, ": holds no pings");
    require_alike(one, cubes.front());
  }
  struct Traced {
    Ping ping;
    PingOrigin origin;
  };
  std::vector<Traced> traced;
  for (std::size_t c = 0; c < cubes.size(); ++c)
    for (Ping& ping : cubes[c].cube.pings) {
      if (!(ping.sound_speed > 0))  // the ping is in the water of its cube
        ping.sound_speed = cubes[c].cube.sound_speed, ping.absorption_db_per_m = cubes[c].cube.absorption_db_per_m;
      traced.push_back({std::move(ping), {c, ping.number}});
    }
  std::stable_sort(traced.begin(), traced.end(),
                   [](const Traced& a, const Traced& b) { return a.ping.time < b.ping.time; });
  std::vector<std::vector<PingNote>> notes;
  for (NamedCube& one : cubes) notes.push_back(std::move(one.cube.notes));
  MergedCube merged;
  merged.cube = std::move(cubes.front().cube);
  std::vector<Ping>& pings = merged.cube.pings;
  pings.clear();
  for (Traced& one : traced) {
    pings.push_back(std::move(one.ping));
    merged.origins.push_back(one.origin);
  }
  count_up_unless_unique(pings);
  merged.cube.notes = merged_notes(std::move(notes), merged);
  drop_unlike_parts(pings);
  return merged;
}

}  // namespace insonify
