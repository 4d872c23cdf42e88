// SPDX-License-Identifier: BSD-3-Clause
#include "scene/built_in_scenes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/built_in_patches_internal.hpp"
#include "scene/sample_patches_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

// Identities of surfels have 32 bits.
constexpr std::size_t most_points = 4000000000;

enum HarbourMaterial : std::uint16_t { sand, concrete, timber, steel, rock, rubber, calibration };

// Returns a cubic step that rises from 0 at a to 1 at b with zero slope at both ends.
double smooth_step(double x, double a, double b) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct SeaBed {
  double phase[4];

  // Returns the height [m] of sand waves, meandering ripples and the scour around the wreck.
  double height(double x, double y) const {
    const double waves =
        0.12 * std::sin(0.31 * x + 0.17 * y + phase[0]) + 0.10 * std::sin(0.13 * x - 0.27 * y + phase[1]);
    const double meander = 1.5 * std::sin(0.23 * y + phase[2]) + 0.8 * std::sin(0.41 * y + 0.2 * x + phase[3]);
    const double ripples = 0.035 * std::sin(2 * pi * (0.9 * x + 0.25 * y + 0.4 * meander) / 1.1);
    const double scour = -0.35 * std::exp(-(Vector2d(x, y) - Vector2d(23, 4)).squaredNorm() / 30);
    return -8 + waves + ripples + scour;
  }

  Patch patch() const {
    const SeaBed bed = *this;
    return {[bed](double u, double v) { return Vector3d(60 * u, 60 * v - 30, bed.height(60 * u, 60 * v - 30)); }, sand};
  }
};

// Returns a wall of cast concrete blocks with a buttress every 5 m, worn joints between blocks and a rough face.
Patch quay_wall() {
  return {[](double u, double v) {
            const double x = 6 + 54 * u, z = -8.4 + 8.3 * v;
            const double from_buttress = std::abs(std::remainder(x, 5.0));
            const double buttress = 0.5 * (1 - smooth_step(from_buttress, 0.3, 0.8));
            const double joint = -0.06 * (std::exp(-std::pow(std::remainder(z, 1.2) / 0.06, 2)) +
                                          std::exp(-std::pow(std::remainder(x - 2.5, 2.5) / 0.06, 2)));
            const double rough =
                0.01 * std::sin(9.1 * x + 4.3 * std::sin(3.7 * z)) + 0.01 * std::sin(11.3 * z + 2.1 * x);
            return Vector3d(x, 20 - buttress - joint - rough, z);
          },
          concrete};
}

void add_pilings(std::vector<Patch>& patches) {
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < 7; ++i) {
      // No piling is exactly vertical.
      const double lean_x = 0.12 * std::sin(2.4 * i + row), lean_y = 0.1 * std::cos(1.7 * i - row);
      Patch piling = cylinder({14 + 5.0 * i, -12.0 - 4.5 * row, -8.3}, {lean_x, lean_y, 8.1}, 0.3);
      piling.material = timber;
      piling.density = 3;
      patches.push_back(std::move(piling));
    }
}

// Transforms ship axes (x to the bow, z up from the deck line) to the world: heeled, and down by the stern.
Vector3d from_ship(const Vector3d& p) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(radians(128), Vector3d::UnitZ()) * Eigen::AngleAxisd(radians(-4), Vector3d::UnitY()) *
       Eigen::AngleAxisd(radians(-14), Vector3d::UnitX()))
          .toRotationMatrix();
  return Vector3d(23, 4, -7.15) + turn * p;
}

constexpr double ship_length = 13;
double half_beam(double u) { return 2.1 * std::sin(0.82 * pi * u); }  // u: 0 at the bow, 1 at the stern
double draught(double u) { return 1.5 + 0.3 * u; }
double ship_x(double u) { return ship_length * (0.5 - u); }

void add_ship_piece(std::vector<Patch>& patches, const Vector3d& inside, Patch patch) {
  patch.at = [at = patch.at](double u, double v) { return from_ship(at(u, v)); };
  patch.material = steel;
  patch.density = 3;
  patches.push_back(facing_away_from(from_ship(inside), std::move(patch)));
}

void add_box(std::vector<Patch>& patches, const Vector3d& low, const Vector3d& size) {
  const Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z()), middle = low + size / 2;
  add_ship_piece(patches, middle, rectangle(low, y, z));
  add_ship_piece(patches, middle, rectangle(low + x, y, z));
  add_ship_piece(patches, middle, rectangle(low, x, z));
  add_ship_piece(patches, middle, rectangle(low + y, x, z));
  add_ship_piece(patches, middle, rectangle(low + z, x, y));
}

void add_wreck(std::vector<Patch>& patches) {
  const Vector3d inside(0, 0, -0.5);
  add_ship_piece(patches, inside, {[](double u, double v) {
                   return Vector3d(ship_x(u), half_beam(u) * std::cos(pi * v), -draught(u) * std::sin(pi * v));
                 }});
  add_ship_piece(patches, inside, {[](double u, double v) {  // deck, cambered
                   const double across = 2 * v - 1;
                   return Vector3d(ship_x(u), half_beam(u) * across, 0.12 * (1 - across * across));
                 }});
  add_ship_piece(patches, inside, {[](double u, double v) {  // transom
                   return Vector3d(ship_x(1), u * half_beam(1) * std::cos(pi * v), -u * draught(1) * std::sin(pi * v));
                 }});
  add_box(patches, {-4.6, -1.0, 0.05}, {2.4, 2.0, 1.35});                                 // wheelhouse
  add_box(patches, {0.2, -0.9, 0.05}, {1.8, 1.8, 0.5});                                   // hatch
  add_ship_piece(patches, {3.0, 0, 1}, cylinder({3.0, 0, 0.05}, {0.9, 0.25, 2.2}, 0.1));  // mast
}

void add_bed_objects(std::vector<Patch>& patches, const SeaBed& bed) {
  const auto put = [&](Patch patch, HarbourMaterial material, double density) {
    patch.material = material;
    patch.density = density;
    patches.push_back(std::move(patch));
  };
  // Pipe of 0.56 m diameter that runs from the jetty towards the wreck.
  const Vector3d from(15.5, -8.5, bed.height(15.5, -8.5) + 0.18), to(33, -3, bed.height(33, -3) + 0.18);
  put(cylinder(from, to - from, 0.28), steel, 3);
  const double boulders[][4] = {{16, 9, 0.55, 0.45}, {18.5, 11.5, 0.8, 0.6}, {20, 14, 0.5, 0.5},
                                {31, -8, 0.9, 0.7},  {34, 12, 1.1, 0.8},     {27, -10, 0.45, 0.4},
                                {36, 3, 0.7, 0.6},   {15.5, 3.5, 0.35, 0.3}, {30, 15, 0.6, 0.55}};
  for (const auto& b : boulders)
    put(ellipsoid({b[0], b[1], bed.height(b[0], b[1]) + 0.2 * b[3]}, {b[2], 0.8 * b[2], b[3]}), rock, 4);
  const double tyres[][2] = {{17, -2.5}, {18.3, -1.2}, {22, 12.5}};
  for (const auto& t : tyres) put(torus({t[0], t[1], bed.height(t[0], t[1]) + 0.1}, 0.42, 0.13), rubber, 8);
  put(ellipsoid({14, -3.5, -5.4}, Vector3d::Constant(0.25)), calibration, 16);
}

/// Returns the surfaces of the harbour: quay wall, pilings, rippled sea bed, wreck, pipe, boulders, tyres and the
/// sphere. `seed` determines the phases of the ripples.
std::vector<Patch> harbour_patches(std::uint64_t seed) {
  SeaBed bed{};
  const auto phase = random_uniform(seed, RandomStage::scene_points, {~0ull, 0, 0});
  for (std::size_t i = 0; i < 4; ++i) bed.phase[i] = 2 * pi * phase[i];
  std::vector<Patch> patches = {bed.patch(), quay_wall()};
  add_pilings(patches);
  add_wreck(patches);
  add_bed_objects(patches, bed);
  return patches;
}

std::vector<Material> harbour_materials() {
  // Orders of magnitude at imaging frequencies, between the sediments of APL-UW TR 9407 (medium sand about
  // -19 dB, rock about -6 dB at 30 kHz) and the energy bound of -5 dB; not calibrated.
  return {{"sand", power_from_db(-19)},
          {"concrete", power_from_db(-14)},
          {"timber", power_from_db(-18)},
          {"steel", power_from_db(-12)},
          {"rock", power_from_db(-9)},
          {"rubber", power_from_db(-20)},
          {"calibration_sphere", power_from_db(-9)}};
}

std::vector<Patch> plane_patches(const BuiltInSceneOptions& options) {
  const double x = options.size.x(), y = options.size.y();
  return {rectangle({0, -y / 2, 0}, {x, 0, 0}, {0, y, 0})};
}

std::vector<Patch> sphere_patches(const BuiltInSceneOptions& options) {
  return {ellipsoid({5, 0, 0}, Vector3d::Constant(options.radius))};
}

// Returns a rectangle in the plane x = const that faces the head: y from low to high, z from bottom to top.
Patch facing_wall(double x, double low, double high, double bottom, double top) {
  return rectangle({x, low, bottom}, {0, 0, top - bottom}, {0, high - low, 0});
}

std::vector<Patch> wall_patches(const BuiltInSceneOptions& options) {
  const double w = options.size.x() / 2, h = options.size.y() / 2, hole = 0.5;
  if (w <= 2 * hole || h <= 2 * hole) return {facing_wall(5, -w, w, -h, h)};
  return {facing_wall(5, -w, w, -h, -hole), facing_wall(5, -w, w, hole, h), facing_wall(5, -w, -hole, -hole, hole),
          facing_wall(5, hole, w, -hole, hole)};
}

std::vector<Patch> pole_patches() {
  std::vector<Patch> patches = {facing_wall(7, -3, 3, -2, 2)};
  for (const double y : {-1.0, 0.0, 1.0}) patches.push_back(cylinder({4, y, -2}, {0, 0, 4}, 0.1));
  return patches;
}

void require_valid(const std::string& name, const BuiltInSceneOptions& options) {
  const std::vector<std::string> names = built_in_scene_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string known;
    for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
    fail(ErrorKind::argument, "make_built_in_scene: no scene '", name, "', must be one of: ", known);
  }
  if (options.points == 0 || options.points > most_points)
    fail(ErrorKind::argument, "make_built_in_scene: points = ", options.points, ", must be 1 to ", most_points);
  if (!(options.size.minCoeff() > 0) || !options.size.allFinite())
    fail(ErrorKind::argument, "make_built_in_scene: size = ", options.size.x(), " x ", options.size.y(),
         " m, must be positive");
  if (!(options.radius > 0) || !std::isfinite(options.radius))
    fail(ErrorKind::argument, "make_built_in_scene: radius = ", options.radius, " m, must be positive");
}

std::vector<Patch> patches_of(const std::string& name, const BuiltInSceneOptions& options) {
  if (name == "harbour") return harbour_patches(options.seed);
  if (name == "reef") return reef_patches(options.seed);
  if (name == "river") return river_patches(options.seed);
  if (name == "plane") return plane_patches(options);
  if (name == "sphere") return sphere_patches(options);
  if (name == "wall") return wall_patches(options);
  return pole_patches();
}

}  // namespace

std::vector<std::string> built_in_scene_names() {
  return {"harbour", "reef", "river", "plane", "sphere", "wall", "poles"};
}

SceneCloud empty_built_in_scene(const std::string& name, const BuiltInSceneOptions& options) {
  require_valid(name, options);
  SceneCloud scene;
  scene.materials = name == "harbour" ? harbour_materials()
                    : name == "reef"  ? reef_materials()
                    : name == "river" ? river_materials()
                                      : std::vector<Material>{{name, options.lambert_mu}};
  return scene;
}

SceneCloud make_built_in_scene(const std::string& name, const BuiltInSceneOptions& options) {
  SceneCloud scene = empty_built_in_scene(name, options);
  sample_patches(scene, patches_of(name, options), options.points, options.seed);
  return scene;
}

void make_built_in_scene_in_batches(const std::string& name, const BuiltInSceneOptions& options, std::size_t batch,
                                    const std::function<void(const SceneCloud&)>& consume) {
  const SceneCloud like = empty_built_in_scene(name, options);
  sample_patches_in_batches(like, patches_of(name, options), options.points, options.seed, batch, consume);
}

}  // namespace insonify
