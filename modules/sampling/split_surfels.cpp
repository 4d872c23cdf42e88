#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sampling/split_surfels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

// Steps of the R2 sequence (Roberts 2018): 1 / g and 1 / g^2 with g^3 = g + 1, the plastic number.
constexpr double step_radius = 0.75487766624669276;  // step_angle = 0.56984029099805327
constexpr std::uint32_t max_parts = 4096;
constexpr double min_range = 1e-6;  // lower bound of range and horizontal distance [m]
constexpr std::size_t max_scatterers = std::size_t{1} << 28, bytes_per_scatterer = 46;

double cos_incidence_of(const Vector3d& normal, const Vector3d& position, double range, bool oriented) {
  const double cosine = -normal.dot(position) / range;
  return std::min(1.0, oriented ? std::max(0.0, cosine) : std::abs(cosine));
}

// atan(t) to double precision for |t| <= 1/16: Taylor series up to t^13.
constexpr double small_tangent = 1.0 / 16;
double atan_of_small(double t) {
  const double q = t * t;
  return t + t * q * (-1.0 / 3 + q * (1.0 / 5 + q * (-1.0 / 7 + q * (1.0 / 9 + q * (-1.0 / 11 + q * (1.0 / 13))))));
}

// Directions of points near a centre without a trigonometric function per point, from the tangents of the angle
// differences; accurate to 1e-15 rad.
class DirectionsNear {
 public:
  DirectionsNear(const Vector3d& centre, double range)
      : azimuth(std::atan2(centre.y(), centre.x())), elevation(std::asin(std::clamp(centre.z() / range, -1.0, 1.0))) {
    const double across = std::sqrt(centre.x() * centre.x() + centre.y() * centre.y());
    if (!(across > min_range)) return;  // straight up or down: differences in azimuth are not small
    ahead_ = {centre.x() / across, centre.y() / across};
    level_ = {across / range, centre.z() / range};
  }

  Direction of(const Vector3d& p, double range) const {
    const double along = ahead_.x() * p.x() + ahead_.y() * p.y(), left = ahead_.x() * p.y() - ahead_.y() * p.x();
    const double across = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const double forth = level_.x() * across + level_.y() * p.z(), up = level_.x() * p.z() - level_.y() * across;
    if (!(std::abs(left) < small_tangent * along && std::abs(up) < small_tangent * forth))
      return {std::atan2(p.y(), p.x()), std::asin(std::clamp(p.z() / range, -1.0, 1.0))};
    const double a = azimuth + atan_of_small(left / along);
    return {std::abs(a) <= pi ? a : a - std::copysign(2 * pi, a), elevation + atan_of_small(up / forth)};
  }

  const double azimuth, elevation;  // direction of the centre

 private:
  Eigen::Vector2d ahead_{0, 0};  // horizontal unit vector towards the centre; 0: no small-angle formula
  Eigen::Vector2d level_{1, 0};  // cosine and sine of the centre's elevation
};

// Generates the offsets of the parts of one surfel in its tangent plane.
class PartSequence {
 public:
  PartSequence(double area, std::uint64_t seed, std::uint32_t id) : disc_radius_(std::sqrt(area / pi)) {
    const auto shift = random_uniform(seed, RandomStage::surfel_split, {id, 0, 0});
    shift_ = shift[0];
    turn_ = std::polar(1.0, 2 * pi * shift[1]);
  }
  // Returns the offset of part k = 1, 2, ..., uniformly distributed over the disc.
  std::complex<double> next() {
    ++k_;
    turn_ *= turn_step_;
    const double u = shift_ + k_ * step_radius;
    return disc_radius_ * std::sqrt(u - std::floor(u)) * turn_;
  }

 private:
  double disc_radius_, shift_ = 0, k_ = 0;
  std::complex<double> turn_;
  static constexpr std::complex<double> turn_step_{-0.90525385836302985,
                                                   -0.42487110035732889};  // exp(2 pi i step_angle)
};

// Number of parts before limits are applied (E17).
double parts_wanted(double area, double range, double cos_incidence, const SplitOptions& options) {
  if (!(options.scatterers_per_cell > 0)) return 1;
  return std::ceil(options.scatterers_per_cell * area / cell_area(range, cos_incidence, options));  // (E17)
}

std::uint32_t bounded(double parts) {
  return parts < max_parts ? std::max(1u, static_cast<std::uint32_t>(parts)) : max_parts;
}

struct Splitter {
  const SceneCloud& scene;
  const HeadFrame& head;
  const SplitOptions& options;

  double wanted(std::uint32_t surfel) const {
    const Vector3d p = head.position(scene.point[surfel]);
    const double range = p.norm();
    const Vector3d normal = head.direction(scene.normal[surfel].cast<double>());
    return parts_wanted(scene.area[surfel], range, cos_incidence_of(normal, p, range, false), options);
  }

  void write(Scatterers& out, std::size_t first, std::size_t parts, std::uint32_t surfel) const {
    const Vector3d world_normal = scene.normal[surfel].cast<double>().normalized();
    const Vector3d normal = head.direction(world_normal), centre = head.position(scene.point[surfel]);
    const double area = scene.area[surfel], share = area / static_cast<double>(parts);
    const auto put = [&](std::size_t k, const Vector3d& position, double range, const Direction& direction) {
      const double cosine = cos_incidence_of(normal, position, range, scene.normals_oriented);
      out.range[first + k] = range;
      out.azimuth[first + k] = direction.azimuth;
      out.elevation[first + k] = direction.elevation;
      out.cos_incidence[first + k] = static_cast<float>(cosine);
      out.projected_area[first + k] = static_cast<float>(share * cosine);
      out.material[first + k] = scene.material[surfel];
      out.id[first + k] = std::uint64_t{scene.id[surfel]} << 32 | k;
      out.surfel[first + k] = surfel;
    };
    const double range = std::max(centre.norm(), min_range);
    const DirectionsNear directions(centre, range);
    put(0, centre, range, {directions.azimuth, directions.elevation});
    if (parts == 1) return;

    const Vector3d tangent = world_normal.unitOrthogonal();
    const Vector3d t1 = head.direction(tangent), t2 = head.direction(world_normal.cross(tangent));
    PartSequence sequence(area, options.seed, scene.id[surfel]);
    for (std::size_t k = 1; k < parts; ++k) {
      const std::complex<double> offset = sequence.next();
      const Vector3d position = centre + (offset.real() * t1 + offset.imag() * t2);
      const double range_of_part = std::max(position.norm(), min_range);
      put(k, position, range_of_part, directions.of(position, range_of_part));
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

double cell_area(double range, double cos_incidence, const SplitOptions& options) {
  const double sine = std::sqrt(std::max(0.0, 1 - cos_incidence * cos_incidence));
  const double dr = options.range_resolution, level = 2 * std::sqrt(2 * range * dr);
  const double length = sine * level > dr ? dr / sine : level;
  double cell = length * range * options.beam_width;
  if (options.row_width > 0) {
    const double narrower = std::min(options.beam_width, options.row_width);
    const double cross_section = range * options.beam_width * range * options.row_width;
    cell = cross_section < cos_incidence * length * range * narrower ? cross_section / cos_incidence
                                                                     : length * range * narrower;
  }
  return cell;
}

std::uint32_t parts_of(double area, double range, double cos_incidence, const SplitOptions& options) {
  return bounded(parts_wanted(area, range, cos_incidence, options));
}

SplitSurfels split_surfels(const SceneCloud& scene, const HeadFrame& head, const std::vector<std::uint32_t>& surfels,
                           const SplitOptions& options) {
  const Splitter splitter{scene, head, options};
  constexpr std::size_t block = 512;
  std::vector<std::size_t> first(surfels.size() + 1, 0);
  std::atomic<std::size_t> capped{0};
  parallel_blocks(surfels.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    std::size_t capped_here = 0;
    for (std::size_t s = begin; s < end; ++s) {
      const double wanted = splitter.wanted(surfels[s]);
      first[s + 1] = bounded(wanted);
      capped_here += wanted > max_parts;
    }
    capped += capped_here;
  });
  for (std::size_t s = 0; s < surfels.size(); ++s) first[s + 1] += first[s];
  if (first.back() > max_scatterers)
    fail(ErrorKind::argument, "split_surfels: ", surfels.size(), " surfels make ", first.back(), " scatterers (",
         first.back() * bytes_per_scatterer >> 30,
         " GiB), must be at most 2^28; lower scatterers_per_cell = ", options.scatterers_per_cell,
         ", or thin the scene");

  SplitSurfels result;
  result.capped = capped;
  resize(result.scatterers, first.back(), options.threads);
  parallel_blocks(surfels.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      splitter.write(result.scatterers, first[s], first[s + 1] - first[s], surfels[s]);
  });
  return result;
}

}  // namespace insonify
