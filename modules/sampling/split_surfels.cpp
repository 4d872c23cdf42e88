// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Geometry>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "core/vector_functions.hpp"
#include "sampling/count_pieces_internal.hpp"
#include "sampling/range_shares_internal.hpp"
#include "sampling/split_loops_internal.hpp"
#include "sampling/split_surfels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double min_range = 1e-6;  // lower bound of range and horizontal distance [m]
constexpr std::size_t surfels_at_once = 512;
constexpr std::size_t surfels_ahead = 8;  // that are loaded into the cache: neighbours stand far apart in the scene

double cos_incidence_of(const Vector3d& normal, const Vector3d& position, double range, bool oriented) {
  const double cosine = -normal.dot(position) / range;
  return std::min(1.0, oriented ? std::max(0.0, cosine) : std::abs(cosine));
}

// Turns of the parts of every surfel: exp(2 pi i k step_angle), k < most_subranges.
struct Turns {
  std::vector<double> re, im;
  Turns() {
    constexpr double step_angle = 0.56984029099805327;  // of the R2 sequence (Roberts 2018): 1 / g^2, g^3 = g + 1
    for (std::uint32_t k = 0; k < most_subranges; ++k) {
      const std::complex<double> turn = std::polar(1.0, 2 * pi * reduced_cycles(k * step_angle));
      re.push_back(turn.real()), im.push_back(turn.imag());
    }
  }
};

constexpr double step_radius = 0.75487766624669276;  // of the R2 sequence, as in place_pieces

/// Writes the parts of one surfel after the other; holds the memory for that.
class Splitter {
 public:
  Splitter(const SceneCloud& scene, const HeadFrame& head, std::uint64_t seed, double range_resolution)
      : scene_(scene), head_(head), seed_(seed), range_resolution_(range_resolution) {}

  /// Loads a surfel into the cache; inline, since the compiler drops calls of functions that do no more.
  INSONIFY_ALWAYS_INLINE void prefetch(std::uint32_t surfel) const {
    __builtin_prefetch(&scene_.point[surfel]);
    __builtin_prefetch(&scene_.normal[surfel]);
    __builtin_prefetch(&scene_.area[surfel]);
    __builtin_prefetch(&scene_.material[surfel]);
    if (!scene_.id.empty()) __builtin_prefetch(&scene_.id[surfel]);
  }

  void write(Scatterers& out, std::size_t first, std::size_t pieces, std::uint32_t surfel) {
    const Centre centre = centre_of(surfel);
    out.range[first] = centre.range;
    out.azimuth[first] = centre.direction.azimuth;
    out.elevation[first] = centre.direction.elevation;
    out.cos_incidence[first] = static_cast<float>(centre.cosine);
    out.projected_area[first] = static_cast<float>(scene_.area[surfel] * centre.cosine);
    for (std::size_t k = 0; k < pieces; ++k) {
      out.material[first + k] = scene_.material[surfel];
      out.id[first + k] = scene_.piece_id(surfel, k);
      out.surfel[first + k] = surfel;
    }
    if (pieces > 1) put_pieces(out, first, pieces, surfel, centre);
  }

 private:
  struct Centre {
    const HeadFrame::Axes& axes;
    Vector3d own_normal, normal, position;  // own: in these axes
    Direction direction;
    double range, cosine;
  };
  static Direction direction_of(const Vector3d& p, double range) {
    return {std::atan2(p.y(), p.x()), std::asin(std::clamp(p.z() / range, -1.0, 1.0))};
  }
  Centre centre_of(std::uint32_t surfel) const {
    const HeadFrame::Axes& axes = head_.axes_of(surfel);
    const Vector3d own_normal = head_.normal_in(axes, surfel).cast<double>().normalized();
    const Vector3d normal = axes.to_head * own_normal, position = head_.position_of(surfel);
    const double range = std::max(position.norm(), min_range);
    return {axes,
            own_normal,
            normal,
            position,
            direction_of(position, range),
            range,
            cos_incidence_of(normal, position, range, scene_.oriented(surfel))};
  }

  /// Places the parts beside the centre, of a low-discrepancy sequence over the disc (E17), and shares the surface.
  void put_pieces(Scatterers& out, std::size_t first, std::size_t pieces, std::uint32_t surfel, const Centre& c) {
    static const Turns turns;
    const Vector3d tangent = c.own_normal.unitOrthogonal();
    const Vector3d t1 = c.axes.to_head * tangent, t2 = c.axes.to_head * c.own_normal.cross(tangent);
    kernels::PieceFrame frame{};
    const auto copy = [](const Vector3d& from, double* to) { std::copy_n(from.data(), 3, to); };
    copy(c.position, frame.centre), copy(t1, frame.t1), copy(t2, frame.t2), copy(c.normal, frame.normal);
    const auto drawn = random_uniform(seed_, RandomStage::surfel_split, {scene_.random_id(surfel), 0, 0});
    const std::complex<double> turn = std::polar(1.0, 2 * pi * drawn[1]);
    frame.radius = std::sqrt(scene_.area[surfel] / pi);
    frame.shift = drawn[0], frame.turn_re = turn.real(), frame.turn_im = turn.imag();
    const double away[] = {t1.dot(c.position) / c.range, t2.dot(c.position) / c.range};
    const double sine = std::sqrt(away[0] * away[0] + away[1] * away[1]);
    frame.away[0] = sine > 0 ? away[0] / sine : 0, frame.away[1] = sine > 0 ? away[1] / sine : 0;
    frame.azimuth = c.direction.azimuth, frame.elevation = c.direction.elevation;
    frame.oriented = scene_.oriented(surfel);
    const double across = c.position.head<2>().norm();
    frame.ahead[0] = c.position.x() / across, frame.ahead[1] = c.position.y() / across;
    frame.level[0] = across / c.range, frame.level[1] = c.position.z() / c.range;

    const std::size_t at = first + 1;
    along_.assign(pieces, 0);
    const bool near = kernels::place_pieces(frame, turns.re.data(), turns.im.data(), pieces - 1,
                                            {out.range.data() + at, out.azimuth.data() + at, out.elevation.data() + at,
                                             out.cos_incidence.data() + at, along_.data() + 1});
    if (!(near && across > min_range)) turn_far(out, at, frame, pieces - 1, turns);
    share(out, first, scene_.area[surfel], 2 * frame.radius * sine);
  }

  /// Shares the surface [m^2] among parts from `first` on, along the line of sight as far as the surfel is deeper [m]
  /// than what is resolved (E128).
  void share(Scatterers& out, std::size_t first, double surface, double depth) {
    const double strips = std::clamp(2 * depth / range_resolution_ - 1, 0.0, 1.0);
    float* area = out.projected_area.data() + first;
    const float* cosine = out.cos_incidence.data() + first;
    if (strips > 0) {
      const std::span<const float> shares = shares_(along_, strips);
      for (std::size_t k = 0; k < shares.size(); ++k) area[k] = static_cast<float>(surface) * shares[k] * cosine[k];
    } else {
      const float each = static_cast<float>(surface / static_cast<double>(along_.size()));
      for (std::size_t k = 0; k < along_.size(); ++k) area[k] = each * cosine[k];
    }
  }

  /// Directions of parts that are not at a small angle to the centre.
  static void turn_far(Scatterers& out, std::size_t at, const kernels::PieceFrame& f, std::size_t count,
                       const Turns& turns) {
    for (std::size_t i = 0; i < count; ++i) {
      const double u = f.shift + static_cast<double>(i + 1) * step_radius;
      const std::complex<double> offset = f.radius * std::sqrt(u - std::floor(u)) * std::complex(f.turn_re, f.turn_im) *
                                          std::complex(turns.re[i + 1], turns.im[i + 1]);
      const Vector3d p = Vector3d(f.centre) + offset.real() * Vector3d(f.t1) + offset.imag() * Vector3d(f.t2);
      const Direction direction = direction_of(p, out.range[at + i]);
      out.azimuth[at + i] = direction.azimuth;
      out.elevation[at + i] = direction.elevation;
    }
  }

  const SceneCloud& scene_;
  const HeadFrame& head_;
  std::uint64_t seed_;
  double range_resolution_;
  std::vector<float> along_;
  RangeShares shares_;
};

// Page faults of new memory cost as much as writing to it, so the arrays are allocated in parallel.
void resize(Scatterers& s, std::size_t n, int threads) {
  parallel_for(8, threads, [&](std::size_t array) {
    switch (array) {
      case 0:
        return s.range.resize(n);
      case 1:
        return s.azimuth.resize(n);
      case 2:
        return s.elevation.resize(n);
      case 3:
        return s.id.resize(n);
      case 4:
        return s.cos_incidence.resize(n);
      case 5:
        return s.projected_area.resize(n);
      case 6:
        return s.surfel.resize(n);
      default:
        return s.material.resize(n);
    }
  });
}

}  // namespace

Scatterers split_surfels(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                         std::span<const std::size_t> first, double range_resolution, std::uint64_t seed, int threads) {
  Scatterers scatterers;
  resize(scatterers, first.back() - first.front(), threads);
  parallel_blocks(surfels.size(), surfels_at_once, threads, [&](std::size_t begin, std::size_t end) {
    Splitter splitter(scene, head, seed, range_resolution);
    for (std::size_t s = begin; s < end; ++s) {
      if (s + surfels_ahead < end) splitter.prefetch(surfels[s + surfels_ahead]);
      splitter.write(scatterers, first[s] - first[0], first[s + 1] - first[s], surfels[s]);
    }
  });
  return scatterers;
}

}  // namespace insonify
