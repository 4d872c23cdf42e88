// SPDX-License-Identifier: BSD-3-Clause
#include "returns/label_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "beamforming/head_patterns.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "returns/beam_responses_internal.hpp"
#include "returns/kinds_in_beam_internal.hpp"
#include "returns/label_kinds_internal.hpp"
#include "returns/surfel_arrivals_internal.hpp"
#include "sonar/pulse.hpp"

// Labels pixels by the surfaces in their cells (E125):
//   1. order the visible parts by direction cosine, with the energy of their pulses in the bins around;
//   2. mark as shadow the cells that hold surfels that are hidden or face away;
//   3. for each beam, add the energies of the parts in its main lobe by bin and label, and those in the cell alone;
//      cells with visible surface are no shadow.
// Cost: parts x beams of a main lobe x bins of a pulse, some 2 ns each; parallel over beams.
namespace insonify {
namespace {

constexpr double anywhere = std::numeric_limits<double>::infinity();

double direction_cosine(const BeamFan& fan, std::size_t beam) {
  return std::cos(fan.elevation[beam]) * std::sin(fan.azimuth[beam]);
}

// Half extents of a cell, or of the main lobe around it.
struct HalfExtent {
  double range, u, up;
};

// The beams of a row by ascending direction cosine.
struct BeamRow {
  double elevation = 0;
  HalfExtent cell{}, lobe{};
  std::vector<std::pair<double, std::size_t>> beams;
};

double half_of_widest_step(const std::vector<double>& ascending) {
  double widest = 0;
  for (std::size_t i = 1; i < ascending.size(); ++i) widest = std::max(widest, ascending[i] - ascending[i - 1]);
  return 0.5 * widest;
}

std::vector<BeamRow> beam_rows(const SonarHead& head, double resolution) {
  const BeamFan& fan = head.fan;
  std::vector<BeamRow> rows;
  std::vector<double> elevations;
  for (const FanRow& fan_row : fan_rows(fan)) {
    BeamRow row{fan_row.elevation, {}, {}, {}};
    elevations.push_back(fan_row.elevation);
    for (const std::size_t beam : fan_row.beams) row.beams.emplace_back(direction_cosine(fan, beam), beam);
    std::sort(row.beams.begin(), row.beams.end());
    rows.push_back(std::move(row));
  }
  const double width_up = fan.row_width > 0 ? fan.row_width : rows.size() > 1 ? fan.elevation_width : anywhere;
  const double step_up = half_of_widest_step(elevations);
  for (BeamRow& row : rows) {
    std::vector<double> u;
    for (const auto& [cosine, beam] : row.beams) u.push_back(cosine);
    const double step_u = half_of_widest_step(u), step_range = 0.5 * head.gate.bin_size;
    row.cell = {std::max(0.5 * resolution, step_range), std::max(0.5 * fan.beam_width, step_u),
                std::max(0.5 * width_up, step_up)};
    row.lobe = {std::max(resolution, step_range), std::max(fan.beam_width, step_u), std::max(width_up, step_up)};
  }
  return rows;
}

double radius_of(const SceneCloud& scene, std::size_t surfel, std::uint32_t parts) {
  return std::sqrt(static_cast<double>(scene.area[surfel]) / (std::numbers::pi * parts));
}

// The visible parts by ascending direction cosine, with the energies of their pulses in `length` bins from `first` on.
struct VisibleParts {
  std::size_t length = 0;
  std::vector<double> u, v, range;
  std::vector<double> radius;  // radius of the part's fraction of its surfel's area [m]
  std::vector<std::uint32_t> surfel;
  std::vector<std::int64_t> first;
  std::vector<float> energy;
};

VisibleParts visible_parts(const SceneCloud& scene, const SurfelEchoes& direct, const SonarHead& head,
                           const Medium& medium, double reach, int threads) {
  const RangeGate& gate = head.gate;
  const Echoes& echoes = direct.echoes;
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double range = 0.5 * medium.sound_speed * echoes.delay[i];
    if (range > gate.min_range - reach && range < gate.max_range + reach)
      order.emplace_back(echoes.u[i], static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end());
  VisibleParts parts;
  parts.length = static_cast<std::size_t>(std::floor(2 * reach / gate.bin_size)) + 1;
  for (auto* column : {&parts.u, &parts.v, &parts.range, &parts.radius}) column->resize(order.size());
  parts.surfel.resize(order.size()), parts.first.resize(order.size()), parts.energy.resize(order.size() * parts.length);
  std::vector<std::uint32_t> parts_of(scene.size(), 0);
  for (const std::uint32_t surfel : direct.surfel) ++parts_of[surfel];
  const EchoShapes shapes(head.pulse, medium);
  parallel_blocks(order.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = order[k].second;
      const double range = 0.5 * medium.sound_speed * echoes.delay[i], power = std::norm(echoes.amplitude[i]);
      const EchoEnvelope envelope = shapes.of(echoes.delay[i], echoes.doppler_of(i));
      parts.u[k] = echoes.u[i], parts.v[k] = echoes.v[i], parts.range[k] = range, parts.surfel[k] = direct.surfel[i];
      parts.radius[k] = radius_of(scene, direct.surfel[i], parts_of[direct.surfel[i]]);
      parts.first[k] = static_cast<std::int64_t>(std::ceil((range - reach - gate.min_range) / gate.bin_size - 0.5));
      for (std::size_t n = 0; n < parts.length; ++n) {
        const double at =
            gate.min_range + (static_cast<double>(parts.first[k]) + static_cast<double>(n) + 0.5) * gate.bin_size;
        parts.energy[k * parts.length + n] =
            static_cast<float>(power * std::norm(envelope.at(2 * (at - range) / medium.sound_speed)));  // (E63)
      }
    }
  });
  return parts;
}

class Labelling {
 public:
  Labelling(const SceneCloud& scene, const SeenSurface& seen, const SonarHead& head, const Pose& world_from_head,
            const Medium& medium, int threads)
      : scene_(scene),
        seen_(seen),
        head_(head),
        head_from_world_(world_from_head.inverse()),
        wavelength_(medium.sound_speed / head.pulse.centre_frequency),
        responses_(head, wavelength_),
        rows_(beam_rows(head, range_resolution(head.pulse, medium.sound_speed))),
        parts_(visible_parts(scene, seen.direct, head, medium, rows_.front().lobe.range, threads)),
        threads_(threads) {
    const auto beams = static_cast<Eigen::Index>(head.fan.beams()), bins = static_cast<Eigen::Index>(head.gate.bins());
    labels_ = {Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::nothing),
               Grid<std::uint32_t>::Constant(beams, bins, PixelLabels::no_id),
               Grid<float>::Zero(beams, bins),
               {}};
    kinds_ = name_kinds(scene, labels_);
    if (!scene.part.empty()) labels_.part = Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::no_part);
  }

  PixelLabels run() {
    std::vector<std::pair<std::size_t, std::size_t>> beams;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      for (std::size_t b = 0; b < rows_[r].beams.size(); ++b) beams.emplace_back(r, b);
    for (std::size_t i = 0; i < scene_.size(); ++i)
      if (seen_.others[i] == Visibility::hidden || seen_.others[i] == Visibility::turned_away)
        mark(i, PixelLabels::shadow);
    for (std::size_t i = 0; i < scene_.size(); ++i)
      if (seen_.others[i] == Visibility::seen) mark(i, PixelLabels::nothing);
    parallel_for(beams.size(), threads_, [&](std::size_t k) {
      label_beam(rows_[beams[k].first], rows_[beams[k].first].beams[beams[k].second]);
    });
    return std::move(labels_);
  }

 private:
  // Labels the pixels of a beam by the energies of the visible parts in its main lobe, by bin and kind.
  void label_beam(const BeamRow& row, std::pair<double, std::size_t> beam) {
    const auto bins = static_cast<std::int64_t>(head_.gate.bins());
    const auto begin = static_cast<std::size_t>(
        std::lower_bound(parts_.u.begin(), parts_.u.end(), beam.first - row.lobe.u) - parts_.u.begin());
    const auto in_lobe = [&](std::size_t k) { return k < parts_.u.size() && parts_.u[k] <= beam.first + row.lobe.u; };
    KindsInBeam here(labels_.names.size(), static_cast<std::size_t>(bins));
    for (std::size_t k = begin; in_lobe(k); ++k)
      here.extend(kinds_.of(scene_, parts_.surfel[k]), parts_.first[k], parts_.length);
    here.make_room();
    const bool weighted = rows_.size() > 1 || head_.column;
    RowResponse response(head_, wavelength_, row.elevation);
    for (std::size_t k = begin; in_lobe(k); ++k) {
      const double up =
          row.lobe.up < anywhere ? std::abs(std::asin(std::clamp(parts_.v[k], -1.0, 1.0)) - row.elevation) : 0;
      if (up > row.lobe.up) continue;
      const double turned = weighted ? response.at(parts_.v[k]) : 1;
      const double weight =
          turned * turned * responses_.intensity(parts_.u[k], parts_.v[k], beam.first, std::sin(row.elevation));
      const double off = std::abs(parts_.u[k] - beam.first), range = parts_.range[k];
      const double part = parts_.radius[k], surfel = radius_of(scene_, parts_.surfel[k], 1);
      const auto lies_within = [&](double radius) {
        return up <= row.cell.up + radius / range && off <= row.cell.u + radius / range;
      };
      const bool of_cell = lies_within(part), of_near = of_cell || lies_within(surfel);
      const std::size_t kind = kinds_.of(scene_, parts_.surfel[k]);
      for (std::size_t n = 0; n < parts_.length; ++n) {
        const std::int64_t bin = parts_.first[k] + static_cast<std::int64_t>(n);
        if (bin < 0 || bin >= bins) continue;
        KindHere& sum = here.at(kind, bin);
        const double energy = weight * static_cast<double>(parts_.energy[k * parts_.length + n]);
        sum.lobe += energy;
        const double away = std::abs(head_.gate.centre(static_cast<std::size_t>(bin)) - range) - row.cell.range;
        const auto add = [&](double& to, double& strongest, std::uint32_t& by) {
          to += energy;
          if (energy > strongest) strongest = energy, by = parts_.surfel[k];
        };
        if (of_cell && away <= part) add(sum.cell, sum.in_cell, sum.of_cell);
        if (of_near && away <= surfel) add(sum.near, sum.in_near, sum.of_near);
      }
    }
    const auto most_in_cell = here.most(&KindHere::cell), most_near = here.most(&KindHere::near);
    for (std::int64_t n = 0; n < bins; ++n)
      label_pixel(beam.second, n, most_in_cell[static_cast<std::size_t>(n)], most_near[static_cast<std::size_t>(n)]);
  }

  // Labels a pixel with the kind of most energy in its cell, or near it if the cell has no surface, seen or hidden.
  void label_pixel(std::size_t beam, Eigen::Index bin, const KindsInBeam::Most& in_cell,
                   const KindsInBeam::Most& near_cell) {
    const auto row = static_cast<Eigen::Index>(beam);
    const bool visible = in_cell.here;
    if (!visible && labels_.material(row, bin) == PixelLabels::shadow) return;
    const auto [most, kind] = visible ? in_cell : near_cell;
    if (!most) return;
    const auto total = static_cast<double>(seen_.all.total[beam * seen_.all.bins + static_cast<std::size_t>(bin)]);
    labels_.material(row, bin) = kind;
    const std::uint32_t strongest = visible ? most->of_cell : most->of_near;
    labels_.id(row, bin) = scene_.id[strongest];
    if (!scene_.part.empty()) labels_.part(row, bin) = scene_.part[strongest];
    labels_.share(row, bin) = total > 0 ? static_cast<float>(std::min(1.0, most->lobe / total)) : 0.0F;  // (E125)
  }

  // Labels the cells that a surfel reaches into.
  void mark(std::size_t i, std::uint16_t label) {
    const Eigen::Vector3d p = head_from_world_ * (scene_.origin + scene_.point[i].cast<double>());
    const double range = std::max(p.norm(), 1e-9), u = p.y() / range, elevation = std::asin(p.z() / range);
    const double radius = radius_of(scene_, i, 1), turn = radius / range;
    const RangeGate& gate = head_.gate;
    const double reach = radius + rows_.front().cell.range;
    const auto first =
        static_cast<Eigen::Index>(std::max(0.0, std::ceil((range - reach - gate.min_range) / gate.bin_size - 0.5)));
    const auto last = static_cast<Eigen::Index>(std::min(
        static_cast<double>(gate.bins()) - 1, std::floor((range + reach - gate.min_range) / gate.bin_size - 0.5)));
    for (const BeamRow& row : rows_) {
      if (std::abs(elevation - row.elevation) > row.cell.up + turn) continue;
      const double across = row.cell.u + turn;
      auto beam = std::lower_bound(row.beams.begin(), row.beams.end(), std::pair(u - across, std::size_t{0}));
      for (; beam != row.beams.end() && beam->first <= u + across; ++beam)
        for (Eigen::Index n = first; n <= last; ++n)
          labels_.material(static_cast<Eigen::Index>(beam->second), n) = label;
    }
  }

  const SceneCloud& scene_;
  const SeenSurface& seen_;
  const SonarHead& head_;
  Pose head_from_world_;
  double wavelength_;
  BeamResponses responses_;
  std::vector<BeamRow> rows_;
  VisibleParts parts_;
  int threads_;
  LabelKinds kinds_;
  PixelLabels labels_;
};

void require_seen(const SceneCloud& scene, const SeenSurface& seen, const SonarHead& head) {
  const Contributors& all = seen.all;
  require_valid(all, "label_pixels");
  if (all.beams != head.fan.beams() || all.bins != head.gate.bins())
    fail(ErrorKind::argument, "label_pixels: contributors of ", all.beams, " beams x ", all.bins, " bins, must be of ",
         head.fan.beams(), " x ", head.gate.bins());
  if (all.total.size() != all.beams * all.bins)
    fail(ErrorKind::argument, "label_pixels: contributors have the total energy of ", all.total.size(),
         " pixels, must have it of all ", all.beams * all.bins, "; label them with the ping, not from a file");
  if (seen.others.size() != scene.size())
    fail(ErrorKind::argument, "label_pixels: visibilities have ", seen.others.size(),
         " entries, must have one per surfel (", scene.size(), ")");
  require_arrivals(scene, seen.direct, "label_pixels");
}

}  // namespace

PixelLabels label_pixels(const SceneCloud& scene, const SeenSurface& seen, const SonarHead& head,
                         const Pose& world_from_head, const Medium& medium, int threads) {
  require_valid(head, "label_pixels");
  require_valid(medium, "label_pixels");
  require_seen(scene, seen, head);
  return Labelling(scene, seen, head, world_from_head, medium, threads).run();
}

}  // namespace insonify
