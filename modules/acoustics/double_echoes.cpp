// SPDX-License-Identifier: BSD-3-Clause
// Echoes by way of two rough surfaces, by rays from surface to surface (Veach 1997, chapter 8: light transport by
// importance sampling; with the phases of sound). Steps, block by block of the surfels seen:
//   1. share_rays   so many rays as a surfel's share of the resolution cells asks for, more where rays of its
//                   neighbours meet a surface in view, fewer where none does
//   2. draw_ray     start in the surfel and direction, with its density of probability
//   3. find_pair    the surface met, the legs to both ends, straight or bent, and how many rays join the two surfels
//   4. add_pair     the two echoes of the pair
#include "acoustics/double_echoes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "acoustics/boundary_internal.hpp"
#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/pair_legs_internal.hpp"
#include "core/random.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "scene/surface_rays.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr double nearest = 1e-3;  // [m]: spreading has no bound nearer to the head
constexpr std::size_t surfels_per_block = 2048;
constexpr std::size_t surfels_per_piece = 1024;  // neighbours, whose rays meet surfaces about as often
constexpr std::size_t least_trials = 2048;       // rays of all pieces that find out how often, or
constexpr std::size_t trials_of_piece = 32;      // so many of each if that is more; an eighth of them first
constexpr double least_share = 0.01;             // of rays that meet one, where no trial does
constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;

/// A ray that leaves a surfel, with the density of probability [1/sr] of its direction.
struct DrawnRay {
  Vector3d from, direction;  ///< world axes; `from` relative to the scene's origin
  double pdf = 0;
};

/// Two surfels that a ray connects, and the way by them.
struct Pair {
  std::uint32_t first, last;
  PathAngles here{}, there{};  ///< angles of the straight way at both patches: in from the head, out to the other patch
  double density = 0;          ///< density of surface where the ray ends (SurfaceRayEnd)
  std::optional<PairPath> way;  ///< absent: no ray connects the two
};

/// Surfels of an echo, and the id of their pair.
struct PairEnds {
  std::uint32_t first, last;
  std::uint64_t id;
};

class PairBuilder {
 public:
  PairBuilder(const PreparedScene& prepared, std::span<const std::uint32_t> seen, const View& view,
              const Transmission& sent, const DoubleEchoOptions& options)
      : scene_(prepared.scene()),
        rays_(prepared.rays(view.sampling.footprint)),
        laws_(surfaces_of(sent, scene_.materials)),
        options_(sent.echo_options),
        head_(view.world_from_head.translation() - scene_.origin),
        legs_(scene_, seen, view, sent, options.through),
        source_(source_pressure(sent.pulse)),
        sound_speed_(sent.medium.sound_speed),
        cycles_per_m_(sent.pulse.centre_frequency / sent.medium.sound_speed),
        seen_(scene_.size(), false),
        number_(scene_.size(), 0) {
    const double margin = pulse_margin(sent);
    least_path_ = 2 * (view.gate.min_range - margin), longest_path_ = 2 * (view.gate.max_range + margin);
    rays_per_cell_ = options.rays_per_cell;
    cell_width_ = view.fan.beam_width * range_resolution(sent.pulse, sound_speed_);
    for (const std::uint32_t i : seen) seen_[i] = true;
    share_rays(prepared.order());
  }

  /// Adds the echoes of the rays from surfel i; returns how many it sent, and adds to `unreached`.
  std::size_t add(std::uint32_t i, Echoes& echoes, std::vector<PairEnds>& ends, std::size_t& unreached) const {
    const double share = random_uniform(options_.seed, RandomStage::surface_ray, {scene_.random_id(i), 0, 1})[0];
    const auto count = static_cast<std::size_t>(number_[i] + share);
    for (std::size_t k = 0; k < count; ++k)
      if (const std::optional<Pair> pair = find_pair(i, k, 0))
        pair->way ? add_pair(*pair, k, echoes, ends) : void(unreached += 2);
    return count;
  }

 private:
  /// Decides how many rays each surfel sends on average. Of all rays, pieces of the scene have shares as the part of
  /// their rays that meets a surface in view. Where the first trials of all pieces meet none, there are none.
  void share_rays(std::span<const std::uint32_t> order) {
    struct Piece {
      std::vector<std::uint32_t> seen;
      double cells = 0;
      std::uint64_t met = 0;
      double share(std::uint64_t trials) const {
        return std::max(least_share, static_cast<double>(met) / static_cast<double>(trials));
      }
    };
    std::vector<Piece> pieces((order.size() + surfels_per_piece - 1) / surfels_per_piece);
    const std::uint64_t trials = std::max(trials_of_piece, least_trials / pieces.size()), first_trials = trials / 8;
    std::atomic<std::uint64_t> met{0};
    const auto meet = [&](Piece& piece, std::uint64_t first, std::uint64_t end) {
      for (std::uint64_t k = first; k < end && !piece.seen.empty(); ++k)
        piece.met += find_pair(piece.seen[k * piece.seen.size() / trials], k, 2).has_value();
      met += piece.met;
    };
    parallel_for(pieces.size(), options_.threads, [&](std::size_t p) {
      for (const std::uint32_t i : order.subspan(p * surfels_per_piece)
                                       .first(std::min(surfels_per_piece, order.size() - p * surfels_per_piece)))
        if (seen_[i]) pieces[p].seen.push_back(i), pieces[p].cells += cells_of(i);
      meet(pieces[p], 0, first_trials);
    });
    if (met == 0) return;
    parallel_for(pieces.size(), options_.threads, [&](std::size_t p) { meet(pieces[p], first_trials, trials); });
    double all = 0, shared = 0;
    for (const Piece& piece : pieces) all += piece.cells, shared += piece.cells * piece.share(trials);
    for (const Piece& piece : pieces)
      for (const std::uint32_t i : piece.seen) number_[i] = cells_of(i) * piece.share(trials) * all / shared;
  }

  Vector3d normal_of(std::uint32_t i, const Vector3d& towards) const {
    const Vector3d normal = scene_.normal[i].cast<double>();
    return !scene_.oriented(i) && normal.dot(towards) < 0 ? -normal : normal;
  }

  /// So many rays a surfel sends if all do alike.
  double cells_of(std::uint32_t i) const {
    return rays_per_cell_ * scene_.area[i] / (cell_width_ * (head_ - scene_.point[i].cast<double>()).norm());
  }

  /// The k-th ray of series `series` from surfel i; of density 0 if it points below the surface.
  DrawnRay draw_ray(std::uint32_t i, std::uint64_t k, std::uint64_t series, const Vector3d& normal,
                    double slope) const {
    const auto [radius, turn, number, angle] =
        random_uniform(options_.seed, RandomStage::surface_ray, {scene_.random_id(i), k, series});
    Eigen::Matrix3d from_surface;  // along, across and off the surface
    from_surface.col(0) = normal.unitOrthogonal(), from_surface.col(2) = normal;
    from_surface.col(1) = normal.cross(from_surface.col(0));
    DrawnRay ray;
    ray.from = scene_.point[i].cast<double>() +
               std::sqrt(radius * scene_.area[i] / pi) *
                   (std::cos(2 * pi * turn) * from_surface.col(0) + std::sin(2 * pi * turn) * from_surface.col(1));
    const Vector3d to_head = (head_ - ray.from).normalized();
    const Vector3d in = from_surface.transpose() * to_head;
    if (!(in.z() > 0)) return ray;
    const Vector3d out = sampled_direction(slope, in, number, angle);
    ray.direction = from_surface * out;
    if (out.z() > 0) ray.pdf = sampling_density(slope, {in.z(), out.z(), in.dot(out)});
    return ray;
  }

  /// Returns the pair of surfel i and the surfel that its k-th ray of a series meets, if both return sound to the head
  /// inside the gate.
  std::optional<Pair> find_pair(std::uint32_t i, std::uint64_t k, std::uint64_t series) const {
    const SurfaceScattering& law = *laws_[scene_.material[i]];
    const Vector3d normal = normal_of(i, head_ - scene_.point[i].cast<double>());
    const DrawnRay ray = draw_ray(i, k, series, normal, law.lobe_slope());
    if (!(ray.pdf > 0)) return {};
    const SurfaceRayEnd hit = rays_.first_hit({i, ray.from.cast<float>(), ray.direction.cast<float>()});
    if (hit.surfel == SurfaceRayEnd::none || !seen_[hit.surfel]) return {};

    const Vector3d to = ray.from + hit.distance * ray.direction, back = legs_.straight_to_head(to);
    const Vector3d out = legs_.straight_to_head(ray.from), normal_there = normal_of(hit.surfel, back);
    Pair pair{i, hit.surfel, {}, {}, 0, {}};
    pair.here = {normal.dot(out), normal.dot(ray.direction), out.dot(ray.direction)};
    pair.there = {normal_there.dot(back), -normal_there.dot(ray.direction), -ray.direction.dot(back)};
    pair.density = hit.density;
    if (!(pair.there.cos_in > 0 && pair.there.cos_out > 0 && pair.density > 0)) return {};
    pair.way = legs_.by({ray.from, normal, pair.here}, {to, normal_there, pair.there}, ray.direction, hit.distance);
    if (!pair.way) return pair;
    if (!(pair.way->pressure > 0 && std::min(pair.way->out.range, pair.way->back.range) > nearest &&
          pair.way->path >= least_path_ && pair.way->path <= longest_path_))
      return {};
    return pair;
  }

  double rays_per_area(std::uint32_t i) const { return scene_.area[i] > 0 ? number_[i] / scene_.area[i] : 0; }

  /// Adds one echo for each sense of the pair that the k-th ray has found.
  void add_pair(const Pair& pair, std::uint64_t k, Echoes& echoes, std::vector<PairEnds>& ends) const {
    const SurfaceScattering &law = *laws_[scene_.material[pair.first]], &law_there = *laws_[scene_.material[pair.last]];
    const double rays =
        rays_per_area(pair.first) * sampling_density(law.lobe_slope(), pair.here) * pair.there.cos_out +
        rays_per_area(pair.last) * sampling_density(law_there.lobe_slope(), pair.there) * pair.here.cos_out;
    const PairPath& way = *pair.way;
    const double power = law.cross_section(way.here) * law_there.cross_section(way.there) * pair.density / rays;
    const double phase = 2 * pi * reduced_cycles(cycles_per_m_ * way.path);
    const double size = way.pressure * std::sqrt(power) / (way.out.range * way.back.range);  // (E159)
    const complex amplitude = source_ * xi(pair.first, k) * std::polar(size, phase);
    const std::uint64_t id = scene_.random_id(pair.first) ^ (k + 1) * golden;
    add_sense(way.out, way.back, way.path, amplitude, {pair.first, pair.last, id}, echoes, ends);
    add_sense(way.back, way.out, way.path, amplitude, {pair.last, pair.first, id}, echoes, ends);
  }

  void add_sense(const HeadLeg& out, const HeadLeg& back, double path, complex amplitude, const PairEnds& from_to,
                 Echoes& echoes, std::vector<PairEnds>& ends) const {
    const complex gain = out.sent * back.gain;
    if (!(std::norm(gain) >= echo_floor * echo_floor)) return;
    add_echo(echoes, path / sound_speed_, back.u, back.v, amplitude * gain);  // (E158)
    ends.push_back(from_to);
  }

  /// The random number of a pair.
  complex xi(std::uint32_t i, std::size_t k) const {
    if (options_.amplitude == SurfaceAmplitude::coherent || options_.amplitude == SurfaceAmplitude::mean_power)
      return 1;
    const complex z = random_complex_normal(options_.seed, RandomStage::double_echo, {scene_.random_id(i), k, 0});
    return options_.amplitude == SurfaceAmplitude::random_phase ? z / std::abs(z) : z;
  }

  const SceneCloud& scene_;
  const SurfaceRays& rays_;
  SurfaceTable laws_;
  const EchoOptions& options_;
  Vector3d head_;  // relative to the scene's origin
  PairLegs legs_;
  double source_, sound_speed_, cycles_per_m_, least_path_ = 0, longest_path_ = 0;
  double rays_per_cell_ = 0, cell_width_ = 0;  // area of a cell over its range [m]
  std::vector<bool> seen_;
  std::vector<double> number_;  // of rays from each surfel, on average
};

}  // namespace

DoubleEchoes double_echoes(const PreparedScene& prepared, std::span<const std::uint32_t> seen, const View& view,
                           const Transmission& sent, const DoubleEchoOptions& options) {
  const SceneCloud& scene = prepared.scene();
  require(options.rays_per_cell >= 1e-6 && options.rays_per_cell <= 1e6, "double_echoes", "rays_per_cell",
          options.rays_per_cell, "", "within 1e-6 and 1e6");
  for (const std::uint32_t i : seen)
    if (i >= scene.size())
      fail(ErrorKind::argument, "double_echoes: seen holds ", i, ", but the scene has ", scene.size(), " surfels");
  DoubleEchoes result;
  if (seen.empty()) return result;
  const PairBuilder builder(prepared, seen, view, sent, options);
  std::vector<std::vector<PairEnds>> ends((seen.size() + surfels_per_block - 1) / surfels_per_block);
  std::atomic<std::size_t> rays{0}, unreached{0};
  result.echoes = collect_echoes(seen.size(), surfels_per_block, sent.echo_options.threads,
                                 [&](std::size_t begin, std::size_t end, Echoes& echoes) {
                                   std::size_t sent_here = 0, lost = 0;
                                   for (std::size_t k = begin; k < end; ++k)
                                     sent_here += builder.add(seen[k], echoes, ends[begin / surfels_per_block], lost);
                                   rays += sent_here, unreached += lost;
                                 });
  result.rays = rays, result.unreached = unreached;
  for (const std::vector<PairEnds>& of_block : ends)
    for (const auto& [first, last, id] : of_block)
      result.first.push_back(first), result.last.push_back(last), result.id.push_back(id);
  return result;
}

Scatterers apparent_positions(const DoubleEchoes& doubles, const SceneCloud& scene, const Pose& world_from_head,
                              double sound_speed, const Environment* through) {
  const Pose head_from_world = world_from_head.inverse();
  std::optional<RefractedLegs> rays;
  if (through && through->profile) rays.emplace(*through->profile, through->water.depth, world_from_head, 0);
  Scatterers positions;
  for (std::size_t i = 0; i < doubles.echoes.size(); ++i) {
    const std::uint32_t last = doubles.last[i];
    Vector3d position = head_from_world * Vector3d(scene.origin + scene.point[last].cast<double>());
    if (const auto refracted = rays ? rays->to(position) : std::nullopt) position = refracted->apparent;
    positions.range.push_back(0.5 * sound_speed * doubles.echoes.delay[i]);
    positions.azimuth.push_back(std::atan2(position.y(), position.x()));
    positions.elevation.push_back(std::asin(std::clamp(position.z() / position.norm(), -1.0, 1.0)));
    positions.material.push_back(scene.material[last]);
    positions.id.push_back(scene.piece_id(last, 0));
  }
  positions.surfel = doubles.last;
  return positions;
}

}  // namespace insonify
