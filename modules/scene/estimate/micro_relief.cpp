// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/micro_relief.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr int triads = 2, max_octaves = 10;

/// Draws four random numbers of one triad; `quantity` distinguishes rotation (0), phases (1) and wavelengths (2).
std::array<double, 4> draw(std::uint64_t seed, int octave, int triad, std::uint64_t quantity) {
  return random_uniform(seed, RandomStage::micro_relief,
                        {static_cast<std::uint64_t>(octave), static_cast<std::uint64_t>(triad), quantity});
}

/// Returns a uniformly distributed rotation (Shoemake 1992); its columns are a triad.
Eigen::Matrix3d random_rotation(const std::array<double, 4>& u) {
  const double a = std::sqrt(1 - u[0]), b = std::sqrt(u[0]);
  return Eigen::Quaterniond(b * std::cos(2 * pi * u[2]), a * std::sin(2 * pi * u[1]), a * std::cos(2 * pi * u[1]),
                            b * std::sin(2 * pi * u[2]))
      .toRotationMatrix();
}

/// Returns sin(2 pi cycles) within 2e-5 without a library call: after reduction to c in [-1/2, 1/2] (adding and
/// subtracting 1.5 * 2^52 rounds to whole cycles) the factor c (1 - 4 c^2) has the zeros of the sine, and the remaining
/// factor is the polynomial in c^2 through four Chebyshev nodes.
template <typename Waves>
Waves sine_of_cycles(const Waves& cycles) {
  constexpr double rounder = 0x1.8p52;
  const Waves c = cycles - ((cycles + rounder) - rounder), s = c * c;
  return c * (1 - 4 * s) *
         (6.283090140640465 + s * (-16.196754386596304 + s * (16.522534541014036 - 8.003611827507179 * s)));
}

}  // namespace

ReliefField::ReliefField(const MicroRelief& relief) {
  if (!(relief.outer_scale > 0 && std::isfinite(relief.outer_scale)))
    fail(ErrorKind::argument, "ReliefField: relief.outer_scale = ", relief.outer_scale, " m, must be finite and > 0");
  if (relief.octaves < 1 || relief.octaves > max_octaves)
    fail(ErrorKind::argument, "ReliefField: relief.octaves = ", relief.octaves, ", must be in 1 .. ", max_octaves);
  octaves_.resize(static_cast<std::size_t>(relief.octaves));

  // Height and wavelength halve together from octave to octave, so every octave contributes the same slope variance.
  const double slope = 1 / std::sqrt(triads * relief.octaves);
  for (int n = 0; n < relief.octaves; ++n) {
    Octave& octave = octaves_[static_cast<std::size_t>(n)];
    for (int triad = 0; triad < triads; ++triad) {
      const Eigen::Matrix3d directions = random_rotation(draw(relief.seed, n, triad, 0));
      const auto phases = draw(relief.seed, n, triad, 1), lengths = draw(relief.seed, n, triad, 2);
      for (int w = 0; w < 3; ++w) {
        const auto drawn = static_cast<std::size_t>(w);
        const int at = 3 * triad + w;
        const Vector3d cycles = directions.col(w) * std::exp2(n + lengths[drawn]) / relief.outer_scale;
        const Vector3d steepest = slope * directions.col(w);
        octave.x[at] = cycles.x(), octave.y[at] = cycles.y(), octave.z[at] = cycles.z();
        octave.slope_x[at] = steepest.x(), octave.slope_y[at] = steepest.y(), octave.slope_z[at] = steepest.z();
        octave.phase[at] = phases[drawn];
      }
    }
  }
}

Vector3d ReliefField::gradient(const Vector3d& p) const {
  Vector3d sum = Vector3d::Zero();
  for (const Octave& o : octaves_) {
    const PerWave wave = sine_of_cycles(PerWave(o.x * p.x() + o.y * p.y() + o.z * p.z() + o.phase));
    sum += Vector3d((o.slope_x * wave).sum(), (o.slope_y * wave).sum(), (o.slope_z * wave).sum());
  }
  return sum;
}

Vector3d tilted_normal(const ReliefField& field, double rms_slope, const Vector3d& world_position,
                       const Vector3d& normal) {
  const Vector3d gradient = field.gradient(world_position);
  return (normal - rms_slope * (gradient - normal * normal.dot(gradient))).normalized();  // (E52)
}

SceneRelief::SceneRelief(const SceneCloud& scene, const MicroRelief& relief) {
  if (scene.parts.empty()) fields_.emplace_back(relief);
  for (const ScenePart& part : scene.parts) {
    const double scale = part.spacing > 0 ? part.spacing : relief.outer_scale;
    fields_.emplace_back(MicroRelief{relief.seed ^ part.key, scale, relief.octaves});
  }
}

Vector3d SceneRelief::facet_of(const SceneCloud& scene, std::size_t surfel, double rms_slope,
                               const Vector3d& world_position) const {
  const ReliefField& field = scene.part.empty() ? fields_.front() : fields_[scene.part[surfel]];
  const ScenePart* part = scene.part_of_surfel(surfel);
  if (!part || !part->own)
    return tilted_normal(field, rms_slope, world_position, scene.normal[surfel].cast<double>().normalized());
  const Vector3d own_normal = part->own->normal[scene.id[surfel]].cast<double>().normalized();
  return part->world_from_part.linear() *
         tilted_normal(field, rms_slope, part->world_from_part.inverse() * world_position, own_normal);
}

std::optional<SceneRelief> relief_of(const SceneCloud& scene, MicroRelief relief) {
  const auto rough = [](const Material& material) { return material.relief_slope > 0; };
  if (scene.size() == 0 || std::none_of(scene.materials.begin(), scene.materials.end(), rough)) return std::nullopt;
  if (relief.outer_scale == 0) relief.outer_scale = whole_of(scene).mean_spacing;
  if (relief.outer_scale == 0) return std::nullopt;
  return SceneRelief(scene, relief);
}

}  // namespace insonify
