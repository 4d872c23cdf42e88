#include "sampling/split_surfels.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

// Steps of the R2 sequence (Roberts 2018): 1 / g and 1 / g^2 with g^3 = g + 1, the plastic number.
constexpr double step_radius = 0.75487766624669276, step_angle = 0.56984029099805327;
constexpr std::uint32_t most_parts = 4096;
constexpr std::size_t most_scatterers = std::size_t{1} << 28, bytes_per_scatterer = 46;

double cos_incidence_of(const Vector3d& normal, const Vector3d& position, double range, bool oriented) {
  const double cosine = -normal.dot(position) / range;
  return std::min(1.0, oriented ? std::max(0.0, cosine) : std::abs(cosine));
}

void write_scatterer(Scatterers& out, std::size_t at, const Vector3d& position, const Vector3d& normal, double area,
                     bool oriented) {
  const double range = std::max(position.norm(), 1e-6);
  const double cosine = cos_incidence_of(normal, position, range, oriented);
  out.range[at] = range;
  out.azimuth[at] = std::atan2(position.y(), position.x());
  out.elevation[at] = std::asin(std::clamp(position.z() / range, -1.0, 1.0));
  out.cos_incidence[at] = static_cast<float>(cosine);
  out.projected_area[at] = static_cast<float>(area * cosine);
}

// Offsets of the parts of one surfel in its tangent plane, one after another.
class PartSequence {
 public:
  PartSequence(double area, std::uint64_t seed, std::uint32_t id) : disc_radius_(std::sqrt(area / pi)) {
    const auto shift = random_uniform(seed, RandomStage::surfel_split, {id, 0, 0});
    shift_ = shift[0];
    turn_ = std::polar(1.0, 2 * pi * shift[1]);
  }
  // Offset of part k = 1, 2, ...: equal areas of the disc are equally likely.
  std::complex<double> next() {
    ++k_;
    turn_ *= turn_step_;
    const double u = shift_ + k_ * step_radius;
    return disc_radius_ * std::sqrt(u - std::floor(u)) * turn_;
  }

 private:
  double disc_radius_, shift_ = 0, k_ = 0;
  std::complex<double> turn_;
  const std::complex<double> turn_step_ = std::polar(1.0, 2 * pi * step_angle);
};

struct Splitter {
  const SceneCloud& scene;
  const HeadFrame& head;
  const SplitOptions& options;

  std::uint32_t parts(std::uint32_t surfel) const {
    const Vector3d p = head.position(scene.point[surfel]);
    const double range = p.norm();
    const Vector3d normal = head.direction(scene.normal[surfel].cast<double>());
    return parts_of(scene.area[surfel], range, cos_incidence_of(normal, p, range, false), options);
  }

  void write(Scatterers& out, std::size_t first, std::size_t parts, std::uint32_t surfel) const {
    const Vector3d world_normal = scene.normal[surfel].cast<double>().normalized();
    const Vector3d tangent = world_normal.unitOrthogonal();
    const Vector3d t1 = head.direction(tangent), t2 = head.direction(world_normal.cross(tangent));
    const Vector3d normal = head.direction(world_normal), centre = head.position(scene.point[surfel]);
    const double area = scene.area[surfel], share = area / static_cast<double>(parts);
    PartSequence sequence(area, options.seed, scene.id[surfel]);
    for (std::size_t k = 0; k < parts; ++k) {
      Vector3d position = centre;
      if (k > 0) {
        const std::complex<double> offset = sequence.next();
        position += offset.real() * t1 + offset.imag() * t2;
      }
      write_scatterer(out, first + k, position, normal, share, scene.normals_oriented);
      out.material[first + k] = scene.material[surfel];
      out.id[first + k] = std::uint64_t{scene.id[surfel]} << 32 | k;
      out.surfel[first + k] = surfel;
    }
  }
};

void resize(Scatterers& s, std::size_t n) {
  s.range.resize(n);
  s.azimuth.resize(n);
  s.elevation.resize(n);
  s.cos_incidence.resize(n);
  s.projected_area.resize(n);
  s.material.resize(n);
  s.id.resize(n);
  s.surfel.resize(n);
}

}  // namespace

std::uint32_t parts_of(double area, double range, double cos_incidence, const SplitOptions& options) {
  if (!(options.scatterers_per_cell > 0)) return 1;
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
  const double parts = std::ceil(options.scatterers_per_cell * area / cell);  // (E17)
  return parts < most_parts ? std::max(1u, static_cast<std::uint32_t>(parts)) : most_parts;
}

Scatterers split_surfels(const SceneCloud& scene, const HeadFrame& head, const std::vector<std::uint32_t>& surfels,
                         const SplitOptions& options) {
  const Splitter splitter{scene, head, options};
  constexpr std::size_t block = 512;
  std::vector<std::size_t> first(surfels.size() + 1, 0);
  parallel_blocks(surfels.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) first[s + 1] = splitter.parts(surfels[s]);
  });
  for (std::size_t s = 0; s < surfels.size(); ++s) first[s + 1] += first[s];
  if (first.back() > most_scatterers)
    fail(ErrorKind::argument, "split_surfels: ", surfels.size(), " surfels make ", first.back(), " scatterers (",
         first.back() * bytes_per_scatterer >> 30,
         " GiB), must be at most 2^28; lower scatterers_per_cell = ", options.scatterers_per_cell,
         ", or thin the scene");

  Scatterers scatterers;
  resize(scatterers, first.back());
  parallel_blocks(surfels.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) splitter.write(scatterers, first[s], first[s + 1] - first[s], surfels[s]);
  });
  return scatterers;
}

}  // namespace insonify
