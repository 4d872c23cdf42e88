// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_explain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/hit_rule_internal.hpp"
#include "sampling/seen_surfels.hpp"

namespace insonify {
namespace {

// Returns the absolute angle between two azimuths.
double azimuth_gap(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

// Extent of a beam's cell in the fan: halfway to its neighbours in azimuth, and its width in elevation.
struct BeamReach {
  double left, right;  // distances from its azimuth, positive [rad]
  double up;           // [rad]
};
BeamReach reach_of(const BeamFan& fan, std::size_t beam) {
  double left = std::numeric_limits<double>::infinity(), right = left;
  for (const double azimuth : fan.azimuth) {
    const double gap = std::remainder(azimuth - fan.azimuth[beam], 2 * pi);
    if (gap > 1e-9) left = std::min(left, gap);
    if (gap < -1e-9) right = std::min(right, -gap);
  }
  // Extend the outermost beams outwards as far as inwards, a single one by its width.
  if (std::isinf(left)) left = right;
  if (std::isinf(right)) right = left;
  if (std::isinf(left)) left = right = fan.beam_width;
  return {left / 2, right / 2, fan.row_width > 0 ? fan.row_width / 2 : fan.elevation_width};
}

// Returns the surfels whose centre lies in the beam's cell and in the bin.
std::vector<std::uint32_t> surfels_at(const SceneCloud& scene, const Ping& ping, PixelPosition position) {
  const HeadFrame head(scene, ping.world_from_head);
  const double elevation = ping.fan.elevation[position.beam];
  const double cone = cone_azimuth(unit_vector({ping.fan.azimuth[position.beam], elevation}));
  const BeamReach reach = reach_of(ping.fan, position.beam);
  const double range = ping.gate.centre(position.bin), half_bin = ping.gate.bin_size / 2;
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3d p = head.position(scene.point[i]);
    const double half_surfel = std::sqrt(static_cast<double>(scene.area[i])) / 2;
    const double near = range - std::max(half_bin, half_surfel), far = range + std::max(half_bin, half_surfel);
    const double squared = p.squaredNorm();
    if (near > 0 && squared < near * near) continue;
    if (squared > far * far || squared == 0) continue;
    const double off = std::remainder(cone_azimuth(p) - cone, 2 * pi);
    if (off > reach.left || -off > reach.right || std::abs(direction_of(p).elevation - elevation) > reach.up) continue;
    found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

// Finds the nearest surfel of the scene that helps to hide one of `hidden`, by the hit rule.
void find_occluder(const SceneCloud& scene, const View& view, PixelVisibility& visibility) {
  const SamplingOptions& sampling = view.sampling;
  const GatedSurfels gated =
      gate_surfels(scene, HeadFrame(scene, view.world_from_head), insonified_sector(view.fan, sampling), view.gate,
                   sampling.footprint, sampling.threads);
  std::vector<const GatedSurfel*> behind;
  for (const GatedSurfel& s : gated)
    if (std::binary_search(visibility.hidden.begin(), visibility.hidden.end(), s.surfel)) behind.push_back(&s);
  constexpr std::size_t enough = 64;  // adjacent surfels mostly share an occluder
  if (behind.size() > enough) behind.resize(enough);
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < gated.size(); ++i)
    for (const GatedSurfel* s : behind) {
      const GatedSurfel& front = gated[i];
      if (front.range < nearest && front.range < s->range && cover(gated, i, LineOfSight(*s)) != 0) {
        nearest = front.range;
        visibility.occluder_range = static_cast<double>(front.range);
        visibility.occluder_surfel = front.surfel;
      }
    }
}

std::string material_name(const ViewerData& data, const SceneCloud& scene, std::uint16_t material) {
  if (scene.size() > 0 && material < scene.materials.size()) return scene.materials[material].name;
  if (material < data.material_names.size()) return data.material_names[material];
  return "material " + std::to_string(material);
}

/// Returns the name of the part of a surfel; empty for a scene that is one part.
std::string part_name(const SceneCloud& scene, std::uint32_t surfel) {
  const ScenePart* part = surfel < scene.size() ? scene.part_of_surfel(surfel) : nullptr;
  return part ? part->name : "";
}

/// Returns the commonest of the numbers of surfels below `count`; number_of(i) is that of surfel i.
template <typename Number>
std::size_t commonest(const std::vector<std::uint32_t>& surfels, std::size_t count, const Number& number_of) {
  std::vector<std::size_t> times(count, 0);
  for (const std::uint32_t i : surfels) ++times[number_of(i)];
  return static_cast<std::size_t>(std::max_element(times.begin(), times.end()) - times.begin());
}

std::string most_common_material(const ViewerData& data, const SceneCloud& scene,
                                 const std::vector<std::uint32_t>& surfels) {
  if (surfels.empty()) return {};
  const std::size_t most =
      commonest(surfels, scene.materials.size(), [&](std::uint32_t i) { return scene.material[i]; });
  return material_name(data, scene, static_cast<std::uint16_t>(most));
}

/// Returns the part that a sample shows: the ping's label, otherwise that of most surfels seen here; empty: none.
std::string part_at(const Ping& ping, PixelPosition position, const SceneCloud& scene,
                    const std::vector<std::uint32_t>& seen) {
  if (const Grid<std::uint16_t> parts = part_image(ping.labels); parts.size() > 0) {
    const std::uint16_t part = parts(static_cast<Eigen::Index>(position.beam), static_cast<Eigen::Index>(position.bin));
    return part < ping.labels.part_names.size() ? ping.labels.part_names[part] : "";
  }
  if (seen.empty() || scene.part.empty()) return {};
  return scene.parts[commonest(seen, scene.parts.size(), [&](std::uint32_t i) { return scene.part[i]; })].name;
}

std::vector<Contribution> contributions_of(const Contributors& list, PixelPosition position, const ViewerData& data,
                                           const SceneCloud& scene) {
  std::vector<Contribution> found;
  for (std::size_t k = 0; k < list.per_pixel; ++k) {
    const std::size_t at = list.at(position.beam, position.bin, k);
    if (list.surfel[at] == Contributors::none) break;
    found.push_back({list.surfel[at], list.id[at], material_name(data, scene, list.material[at]),
                     static_cast<double>(list.share[at]), static_cast<double>(list.elevation[at]), list.path[at],
                     part_name(scene, list.surfel[at])});
  }
  return found;
}

constexpr const char* path_texts[] = {"direct", "by one bounce", "by two bounces", "by two surfaces"};  // by PathKind

std::string bearing_words(double azimuth) {
  const double bearing_deg = -degrees(azimuth);
  if (std::abs(bearing_deg) < 0.005) return "0.00° (ahead)";
  return printed("%+.2f° (%s)", bearing_deg, bearing_deg > 0 ? "starboard" : "port");
}

std::string contributor_lines(const PixelFacts& facts) {
  if (!facts.contributions_known) return {};
  if (facts.contributions.empty()) return "No surfel contributes: the sample\n  holds side lobes or noise\n";
  std::string text = "Strongest contributor:\n";
  for (const Contribution& c : facts.contributions)
    text += "  " + (c.part.empty() ? "" : c.part + ": ") + c.material +
            printed(", surfel %u (id %u)\n", c.surfel, c.id) +
            printed("  %.0f %% of the energy, %s, elevation %+.2f°\n", 100 * c.share,
                    path_texts[static_cast<std::size_t>(c.path)], degrees(c.elevation));
  return text;
}

std::string visibility_lines(const PixelVisibility& visibility, const std::string& seen_material) {
  if (visibility.seen.empty() && visibility.hidden.empty() && visibility.turned_away == 0) return {};
  std::string text = printed("Surfels in this sample: %zu seen", visibility.seen.size());
  if (!seen_material.empty()) text += " (" + seen_material + ")";
  text += printed(",\n  %zu hidden, %zu face away\n", visibility.hidden.size(), visibility.turned_away);
  if (visibility.occluder_range) text += printed("Shadow of a surfel at %.3f m\n", *visibility.occluder_range);
  return text;
}

}  // namespace

PixelVisibility look_at_pixel(const ViewerData& data, const SceneCloud& scene, const Ping& ping,
                              PixelPosition position) {
  PixelVisibility visibility;
  const std::vector<std::uint32_t> here = surfels_at(scene, ping, position);
  if (here.empty()) return visibility;
  std::vector<std::uint8_t> queried(scene.size(), 0);
  for (const std::uint32_t i : here) queried[i] = 1;
  const View view = view_at(data, ping.world_from_head, ping.fan, ping.gate);
  const std::vector<Visibility> answer =
      find_visibility(scene, view.world_from_head, view.fan, view.gate, queried, view.sampling);
  for (const std::uint32_t i : here) {
    if (answer[i] == Visibility::seen) visibility.seen.push_back(i);
    if (answer[i] == Visibility::hidden) visibility.hidden.push_back(i);
    if (answer[i] == Visibility::turned_away) ++visibility.turned_away;
  }
  if (!visibility.hidden.empty()) find_occluder(scene, view, visibility);
  return visibility;
}

PixelFacts find_pixel_facts(const ViewerData& data, std::size_t ping_index, PixelPosition position) {
  const ViewerExtent extent = extent_of(data);
  if (ping_index >= extent.pings || position.beam >= extent.beams || position.bin >= extent.bins)
    fail(ErrorKind::argument, "find_pixel_facts: ping ", ping_index, ", beam ", position.beam, ", bin ", position.bin,
         ", must be below ", extent.pings, ", ", extent.beams, ", ", extent.bins);
  const auto shown = data.pings.ping(ping_index);
  const Ping& ping = *shown;
  const std::shared_ptr<const SceneCloud> of_ping = scene_at(data, ping_index);
  const SceneCloud& scene = *of_ping;
  PixelFacts facts;
  facts.position = position;
  facts.ping_number = ping.number;
  facts.range = ping.gate.centre(position.bin);
  facts.azimuth = ping.fan.azimuth[position.beam];
  facts.elevation = ping.fan.elevation[position.beam];
  if (ping.scan) facts.scan_angle = ping.scan->angle;
  const auto row = static_cast<Eigen::Index>(position.beam), column = static_cast<Eigen::Index>(position.bin);
  facts.level_db = pressure_level_db(static_cast<double>(std::abs(ping.pressure(row, column))));  // (E6)
  facts.unit = unit_of(data, false);
  facts.compensated_level_db =
      facts.level_db + 40 * std::log10(facts.range) + 2 * ping.absorption_db_per_m * facts.range;  // (E20)
  if (!data.contributors.empty() && !data.contributors[ping_index].empty()) {
    facts.contributions_known = true;
    facts.contributions = contributions_of(data.contributors[ping_index], position, data, scene);
  }
  if (ping.unknown.size() > 0) facts.unknown = ping.unknown(row, column) != 0;
  if (scene.size() > 0) {
    facts.visibility = look_at_pixel(data, scene, ping, position);
    facts.seen_material = most_common_material(data, scene, facts.visibility->seen);
  }
  facts.part = part_at(ping, position, scene, facts.visibility ? facts.visibility->seen : std::vector<std::uint32_t>{});
  return facts;
}

std::string explain_pixel(const PixelFacts& facts) {
  std::string text = printed("Ping %lld, beam %zu, bin %zu\n", static_cast<long long>(facts.ping_number),
                             facts.position.beam, facts.position.bin);
  text += printed("Range %.3f m\n", facts.range);
  text += "Bearing " + bearing_words(std::remainder(facts.azimuth + facts.scan_angle.value_or(0), 2 * pi)) + "\n";
  if (facts.scan_angle) text += "  Turn of the head " + bearing_words(std::remainder(*facts.scan_angle, 2 * pi)) + "\n";
  text += printed("Elevation of the beam %+.2f°\n", degrees(facts.elevation));
  if (std::isfinite(facts.level_db)) {
    text += printed("Level %.1f %s\n", facts.level_db, facts.unit.c_str());
    text += printed("  %.1f dB range compensated\n", facts.compensated_level_db);
  } else {
    text += "Level: no sound in this sample\n";
  }
  if (!facts.part.empty()) text += "Part " + facts.part + "\n";
  text += contributor_lines(facts);
  if (facts.visibility) text += visibility_lines(*facts.visibility, facts.seen_material);
  if (facts.unknown) text += "Hole of the scan: surface may be\n  missing here\n";
  return text;
}

std::vector<std::uint32_t> surfels_behind(const PixelFacts& facts) {
  std::vector<std::uint32_t> surfels;
  for (const Contribution& c : facts.contributions) surfels.push_back(c.surfel);
  if (!facts.contributions_known && facts.visibility) surfels = facts.visibility->seen;
  return surfels;
}

std::optional<PixelPosition> position_of(const Ping& ping, const Eigen::Vector3d& world_position) {
  const Eigen::Vector3d p = ping.world_from_head.inverse() * world_position;
  const double range = p.norm(), bin = std::floor((range - ping.gate.min_range) / ping.gate.bin_size);
  if (!(bin >= 0 && bin < static_cast<double>(ping.gate.bins()))) return {};
  const Direction direction = direction_of(p);
  const BeamFan& fan = ping.fan;
  const auto distance = [&](std::size_t b) {
    return std::pair(azimuth_gap(fan.azimuth[b], direction.azimuth), std::abs(fan.elevation[b] - direction.elevation));
  };
  std::size_t nearest = 0;
  for (std::size_t b = 1; b < fan.beams(); ++b) {
    const auto [here, up_here] = distance(b);
    const auto [best, up_best] = distance(nearest);
    if (here < best - 1e-9 || (here < best + 1e-9 && up_here < up_best)) nearest = b;
  }
  const BeamReach reach = reach_of(fan, nearest);
  const double off = std::remainder(direction.azimuth - fan.azimuth[nearest], 2 * pi);
  if (off > reach.left || -off > reach.right) return {};
  return PixelPosition{nearest, static_cast<std::size_t>(bin)};
}

}  // namespace insonify
