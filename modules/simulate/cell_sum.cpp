// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "acoustics/multipath_echoes.hpp"
#include "beamforming/engine.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/cell_labels.hpp"
#include "sampling/sampled_cells.hpp"
#include "simulate/cell_sum_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t patches_at_once = 4096;
constexpr double least_cosine = 1e-3;
constexpr double least_part_of_cell = 0.125;  // area of a patch from which on it is a disc; samples split it
constexpr double two_rings_of_cell = 1.1;     // the same from which on a disc is two rings of points
constexpr double least_tilt = 1e-6;           // square of the sine from which on a plane has ranges
constexpr double no_noise_db = -std::numeric_limits<double>::infinity();

/// How u changes along a plane with range, and how it changes at one range, both times the range (E189). The direction is
/// that from the head; both are in its axes.
struct TiltInU {
  double slope = 0, across = 0;
  TiltInU(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) {
    const double u = direction.y();
    const double facing = normal.dot(direction), aside = normal.y() - u * facing;
    const double range_square = 1 - facing * facing, u_square = std::max(0.0, 1 - u * u - aside * aside);
    if (range_square > least_tilt) slope = -facing * aside / range_square;
    across = std::sqrt(std::max(0.0, u_square - slope * slope * std::max(0.0, range_square)));
  }
};

/// Makes discs of patches of a scene (E228). Two axes of each stand with its surfel, and so with the part of the scene that
/// it is of.
class DiscMaker {
 public:
  /// Keeps a reference to the scene.
  DiscMaker(const SceneCloud& scene, const Eigen::Matrix3d& to_head) : scene_(scene), to_head_(to_head.cast<float>()) {
    for (const ScenePart& part : scene.parts)
      part_to_head_.push_back(part.own ? Eigen::Matrix3f((to_head * part.world_from_part.linear()).cast<float>())
                                       : to_head_);
  }
  /// Returns a patch of a surfel as a disc; direction: that from the head, in its axes; range, radius [m].
  EchoDisc of(std::uint32_t surfel, const Eigen::Vector3d& direction, double range, double radius) const {
    const ScenePart* const part = scene_.part_of_surfel(surfel);
    const Eigen::Vector3f normal = part && part->own ? part->own->normal[scene_.id[surfel]] : scene_.normal[surfel];
    const Eigen::Matrix3f& to_head = part ? part_to_head_[scene_.part[surfel]] : to_head_;
    const Eigen::Vector3f along = normal.unitOrthogonal(), across = normal.cross(along), to = direction.cast<float>();
    const Eigen::Vector3f axis[] = {to_head * along, to_head * across};
    EchoDisc disc;
    for (const int k : {0, 1}) {
      const float away = axis[k].dot(to);
      disc.range[k] = static_cast<float>(radius) * away;
      disc.u[k] = static_cast<float>(radius / range) * (axis[k].y() - to.y() * away);
    }
    return disc;
  }

 private:
  const SceneCloud& scene_;
  Eigen::Matrix3f to_head_;
  std::vector<Eigen::Matrix3f> part_to_head_;
};

/// Surfaces that direct echoes stand for, by patches of surfels.
class PatchSurfaces {
 public:
  /// Keeps references to all arguments.
  PatchSurfaces(const ResolvedPing& ping, const SceneCloud& scene, const Scatterers& patches, const Echoes& echoes)
      : scene_(scene),
        patches_(patches),
        echoes_(echoes),
        fan_(ping.head.fan),
        cells_(fan_, ping.head.gate, ping.view.sampling),
        to_head_(ping.view.world_from_head.linear().transpose()),
        discs_(scene, to_head_) {
    for (const double azimuth : fan_.azimuth) widest_ = std::max(widest_, std::abs(std::sin(azimuth)));
  }

  /// Returns true if patch i is the first of its surfel, which is its middle.
  bool is_middle(std::size_t i) const { return i == 0 || patches_.surfel[i - 1] != patches_.surfel[i]; }

  /// Returns patch i as a disc; a point where it is small beside a cell (E228).
  EchoDisc disc_of(std::size_t i) const {
    const double range = patches_.range[i], cosine = cosine_of(i),
                 area = static_cast<double>(patches_.projected_area[i]) / cosine,
                 cell = cells_.area(range, cosine, {fan_.beam_width, fan_.row_width});
    if (!(area > least_part_of_cell * cell)) return {};
    EchoDisc disc = discs_.of(patches_.surfel[i], direction_of(i), range, std::sqrt(area / pi));
    disc.two_rings = std::abs(echoes_.u[i]) < widest_ && area > two_rings_of_cell * cell;
    return disc;
  }

  /// Sets energy and extent of the surfel whose first patch is i (E181, E189) as those of entry `at`.
  void set_surfel(std::size_t i, SurfaceEchoes& surface, std::size_t at) const {
    const std::uint32_t surfel = patches_.surfel[i];
    double power = 0, area = 0;
    for (std::size_t k = i; k < patches_.size() && patches_.surfel[k] == surfel; ++k)
      power += std::norm(echoes_.amplitude[k]), area += static_cast<double>(patches_.projected_area[k]);
    const double range = patches_.range[i], cosine = cosine_of(i),
                 half = spread_of_disc * std::sqrt(area / cosine / pi);
    const TiltInU tilt(direction_of(i), to_head_ * scene_.normal[surfel].cast<double>());
    surface.power[at] = power;
    surface.depth[at] = static_cast<float>(half * std::sqrt(std::max(0.0, 1 - cosine * cosine)));
    surface.width[at] = static_cast<float>(half / range);
    surface.slope[at] = static_cast<float>(tilt.slope / range);
    surface.across[at] = static_cast<float>(half / range * tilt.across);
  }

 private:
  double cosine_of(std::size_t i) const {
    return std::max(static_cast<double>(patches_.cos_incidence[i]), least_cosine);
  }
  /// Returns the direction from the head to patch i, in its axes.
  Eigen::Vector3d direction_of(std::size_t i) const {
    const double u = echoes_.u[i], v = echoes_.v.empty() ? std::sin(patches_.elevation[i]) : echoes_.v[i];
    const double ahead = std::sqrt(std::max(0.0, 1 - u * u - v * v));
    return {std::abs(patches_.azimuth[i]) > 0.5 * pi ? -ahead : ahead, u, v};
  }

  const SceneCloud& scene_;
  const Scatterers& patches_;
  const Echoes& echoes_;
  const BeamFan& fan_;
  SampledCells cells_;
  Eigen::Matrix3d to_head_;
  DiscMaker discs_;
  double widest_ = 0;  // largest u of a beam
};

}  // namespace

void CellSum::add_direct(const SceneCloud& scene, const Scatterers& patches, const Echoes& echoes) {
  const std::size_t before = all_.id.size();
  append(all_.echoes, echoes);
  if (ping_.options.outputs.labels) surfel_ = patches.surfel;
  all_.id.insert(all_.id.end(), patches.id.begin(), patches.id.end());
  const std::size_t count = all_.id.size();
  all_.power.resize(count, 0), all_.depth.resize(count, 0), all_.width.resize(count, 0), all_.slope.resize(count, 0);
  all_.across = all_.width;
  all_.disc.resize(count);
  const PatchSurfaces surfaces(ping_, scene, patches, echoes);
  parallel_blocks(patches.size(), patches_at_once, ping_.options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      all_.disc[before + i] = surfaces.disc_of(i);
      // The first patch of a surfel has the energy of all.
      if (surfaces.is_middle(i)) surfaces.set_surfel(i, all_, before + i);
    }
  });
  note("direct", before, 0);
}

void CellSum::add_reverberation(const std::string& name, Echoes echoes, std::size_t number) {
  const std::size_t before = all_.id.size();
  if (water_begin_ == 0) water_begin_ = before;
  // Numbers of their own, far from those of surfels.
  const std::uint64_t first = (0xffff0000 + number) << 32;
  for (std::size_t i = 0; i < echoes.size(); ++i)
    all_.id.push_back((first + i) ^ (static_cast<std::uint64_t>(ping_.event.number) * 0x9e3779b97f4a7c15));
  for (const std::complex<double>& amplitude : echoes.amplitude) all_.power.push_back(std::norm(amplitude));
  append(all_.echoes, echoes);
  all_.depth.resize(all_.id.size(), 0), all_.width.resize(all_.id.size(), 0);
  note(name, before, fixed_.size());
}

void CellSum::add(const std::string& name, const SurfaceEchoes& surface, const Echoes& fixed) {
  const std::size_t before = all_.id.size(), before_fixed = fixed_.size();
  append(all_.echoes, surface.echoes), append(fixed_, fixed);
  all_.id.insert(all_.id.end(), surface.id.begin(), surface.id.end());
  all_.power.insert(all_.power.end(), surface.power.begin(), surface.power.end());
  all_.depth.insert(all_.depth.end(), surface.depth.begin(), surface.depth.end());
  all_.width.insert(all_.width.end(), surface.width.begin(), surface.width.end());
  note(name, before, before_fixed);
}

void CellSum::note(const std::string& name, std::size_t first, std::size_t first_fixed) {
  layers_.push_back({name, first, all_.id.size(), first_fixed, fixed_.size()});
  const auto both = std::count(all_.id.begin() + static_cast<std::ptrdiff_t>(first), all_.id.end(), all_.of_both);
  report_.push_back({name, all_.id.size() - first - static_cast<std::size_t>(both) + fixed_.size() - first_fixed});
}

CellOptions CellSum::options_with(double noise_db) const {
  const SimulationOptions& o = ping_.options;
  CellOptions options;
  options.seed = o.seed, options.ping = ping_.event.number, options.threads = o.threads;
  options.speckle = !gives_power(o.synthesis.method);
  options.element_noise_db = noise_db;
  return options;
}

ComplexGridF CellSum::drawn(const SurfaceEchoes& surface, const Echoes& fixed, double noise_db) const {
  return stored_cells(synthesizers_.cells_of(ping_.head, ping_.sent.medium, ping_.samples.bin_size)
                          ->cells(surface, fixed, options_with(noise_db)),
                      "PingSimulator");
}

ComplexGridF CellSum::labelled(const SceneCloud& scene, double noise_db, PixelLabels& labels) const {
  const EchoLabels of_echoes{label_numbers(scene, surfel_), water_begin_, water_begin_ > 0 ? all_.id.size() : 0};
  CellLabels shown;
  const auto synthesizer = synthesizers_.cells_of(ping_.head, ping_.sent.medium, ping_.samples.bin_size);
  ComplexGridF cells =
      stored_cells(synthesizer->cells(all_, fixed_, options_with(noise_db), of_echoes, shown), "PingSimulator");
  labels = labels_of_cells(scene, shown, surfel_, all_.echoes.v);
  return cells;
}

ComplexGridF CellSum::drawn(const Span& layer) const {
  const auto part = [](const auto& all, std::size_t first, std::size_t end) {
    return std::remove_cvref_t<decltype(all)>(all.begin() + static_cast<std::ptrdiff_t>(first),
                                              all.begin() + static_cast<std::ptrdiff_t>(end));
  };
  const auto echoes = [&](const Echoes& all, std::size_t first, std::size_t end) {
    return Echoes{part(all.delay, first, end), part(all.u, first, end), part(all.amplitude, first, end),
                  part(all.v, first, end)};
  };
  const auto& [name, first, end, first_fixed, end_fixed] = layer;
  const auto tilted = [&, first = first, end = end](const auto& all) {
    return part(all, std::min(first, all.size()), std::min(end, all.size()));
  };
  return drawn({echoes(all_.echoes, first, end), part(all_.id, first, end), part(all_.power, first, end),
                part(all_.depth, first, end), part(all_.width, first, end), tilted(all_.slope), tilted(all_.across),
                tilted(all_.disc)},
               echoes(fixed_, first_fixed, end_fixed), no_noise_db);
}

void CellSum::finish(const SceneCloud& scene, SimulatedPing& result) {
  const SimulationOptions& o = ping_.options;
  const double noise_db = o.effects.noise ? ping_.element_noise_db : no_noise_db;
  PixelLabels labels;
  result.ping = ping_of(ping_, ping_.head.gate,
                        o.outputs.labels ? labelled(scene, noise_db, labels) : drawn(all_, fixed_, noise_db));
  result.ping.labels = std::move(labels);
  if (o.outputs.layers) {
    for (const Span& layer : layers_) result.ping.layers.push_back({layer.name, drawn(layer)});
    if (o.effects.noise) result.ping.layers.push_back({"noise", drawn({}, {}, noise_db)});
  }
  if (o.effects.noise) report_.push_back({"noise", 0});
  result.ping.expected_level = gives_power(o.synthesis.method);
  result.ping.display_cells = true;
  result.report.layers = std::move(report_);
}

}  // namespace insonify
