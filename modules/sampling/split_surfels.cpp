#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Geometry>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sampling/count_parts_internal.hpp"
#include "sampling/split_loops_internal.hpp"
#include "sampling/split_surfels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double min_range = 1e-6;  // lower bound of range and horizontal distance [m]
constexpr std::size_t surfels_at_once = 512;

double cos_incidence_of(const Vector3d& normal, const Vector3d& position, double range, bool oriented) {
  const double cosine = -normal.dot(position) / range;
  return std::min(1.0, oriented ? std::max(0.0, cosine) : std::abs(cosine));
}

// Turns of the parts of every surfel: exp(2 pi i k step_angle), k < most_parts.
struct Turns {
  std::vector<double> re, im;
  Turns() {
    constexpr double step_angle = 0.56984029099805327;  // of the R2 sequence (Roberts 2018): 1 / g^2, g^3 = g + 1
    for (std::uint32_t k = 0; k < most_parts; ++k) {
      const std::complex<double> turn = std::polar(1.0, 2 * pi * reduced_cycles(k * step_angle));
      re.push_back(turn.real()), im.push_back(turn.imag());
    }
  }
};

constexpr double step_radius = 0.75487766624669276;  // of the R2 sequence, as in place_parts

struct Splitter {
  const SceneCloud& scene;
  const HeadFrame& head;
  std::uint64_t seed;

  void write(Scatterers& out, std::size_t first, std::size_t parts, std::uint32_t surfel) const {
    const Vector3d world_normal = scene.normal[surfel].cast<double>().normalized();
    const Vector3d normal = head.direction(world_normal), centre = head.position(scene.point[surfel]);
    const double area = scene.area[surfel], share = area / static_cast<double>(parts);
    const double range = std::max(centre.norm(), min_range);
    const double cosine = cos_incidence_of(normal, centre, range, scene.normals_oriented);
    const Direction direction = direction_of(centre, range);
    out.range[first] = range;
    out.azimuth[first] = direction.azimuth;
    out.elevation[first] = direction.elevation;
    out.cos_incidence[first] = static_cast<float>(cosine);
    out.projected_area[first] = static_cast<float>(share * cosine);
    for (std::size_t k = 0; k < parts; ++k) {
      out.material[first + k] = scene.material[surfel];
      out.id[first + k] = std::uint64_t{scene.id[surfel]} << 32 | k;
      out.surfel[first + k] = surfel;
    }
    if (parts > 1) place(out, first, parts, surfel, {world_normal, normal, centre, direction, range, share});
  }

 private:
  struct Centre {
    Vector3d world_normal, normal, position;
    Direction direction;
    double range, share;
  };
  static Direction direction_of(const Vector3d& p, double range) {
    return {std::atan2(p.y(), p.x()), std::asin(std::clamp(p.z() / range, -1.0, 1.0))};
  }

  /// Places the parts beside the centre, of a low-discrepancy sequence over the disc (E17).
  void place(Scatterers& out, std::size_t first, std::size_t parts, std::uint32_t surfel, const Centre& c) const {
    static const Turns turns;
    const Vector3d tangent = c.world_normal.unitOrthogonal();
    kernels::PartFrame frame{};
    const auto copy = [](const Vector3d& from, double* to) { std::copy_n(from.data(), 3, to); };
    copy(c.position, frame.centre);
    copy(head.direction(tangent), frame.t1);
    copy(head.direction(c.world_normal.cross(tangent)), frame.t2);
    copy(c.normal, frame.normal);
    const auto drawn = random_uniform(seed, RandomStage::surfel_split, {scene.id[surfel], 0, 0});
    const std::complex<double> turn = std::polar(1.0, 2 * pi * drawn[1]);
    frame.radius = std::sqrt(scene.area[surfel] / pi);
    frame.shift = drawn[0], frame.turn_re = turn.real(), frame.turn_im = turn.imag();
    frame.azimuth = c.direction.azimuth, frame.elevation = c.direction.elevation;
    frame.oriented = scene.normals_oriented;
    const double across = std::hypot(c.position.x(), c.position.y());
    frame.ahead[0] = c.position.x() / across, frame.ahead[1] = c.position.y() / across;
    frame.level[0] = across / c.range, frame.level[1] = c.position.z() / c.range;

    const std::size_t at = first + 1;
    const bool near = kernels::place_parts(frame, turns.re.data(), turns.im.data(), parts - 1, c.share,
                                           {out.range.data() + at, out.azimuth.data() + at, out.elevation.data() + at,
                                            out.cos_incidence.data() + at, out.projected_area.data() + at});
    if (!(near && across > min_range)) turn_far(out, at, frame, parts - 1, turns);
  }

  /// Directions of parts that are not at a small angle to the centre.
  static void turn_far(Scatterers& out, std::size_t at, const kernels::PartFrame& f, std::size_t count,
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
                         std::span<const std::size_t> first, std::uint64_t seed, int threads) {
  Scatterers scatterers;
  const Splitter splitter{scene, head, seed};
  resize(scatterers, first.back() - first.front(), threads);
  parallel_blocks(surfels.size(), surfels_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      splitter.write(scatterers, first[s] - first[0], first[s + 1] - first[s], surfels[s]);
  });
  return scatterers;
}

}  // namespace insonify
