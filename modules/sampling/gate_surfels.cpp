#include "sampling/gate_surfels.hpp"

#include <cmath>

#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double nothing_nearer = 1e-6;  // [m]: the head itself

// A sector as four half-spaces: signed distances need no trigonometry per point.
class SectorTest {
 public:
  explicit SectorTest(const Sector& sector)
      : whole_circle_(sector.max_azimuth - sector.min_azimuth >= 2 * pi),
        convex_(sector.max_azimuth - sector.min_azimuth <= pi),
        port_(std::sin(sector.max_azimuth), -std::cos(sector.max_azimuth)),
        starboard_(-std::sin(sector.min_azimuth), std::cos(sector.min_azimuth)),
        top_(std::sin(sector.max_elevation), cos_elevation(sector.max_elevation)),
        bottom_(std::sin(sector.min_elevation), cos_elevation(sector.min_elevation)) {}

  // True if a sphere of radius `margin` round p may reach into the sector; exact for margin 0.
  bool holds(const Vector3d& p, double margin) const {
    const double across = std::hypot(p.x(), p.y());
    if (p.z() * top_.y() - across * top_.x() > margin) return false;
    if (across * bottom_.x() - p.z() * bottom_.y() > margin) return false;
    if (whole_circle_) return true;
    const bool from_port = port_.dot(p.head<2>()) >= -margin, from_starboard = starboard_.dot(p.head<2>()) >= -margin;
    return convex_ ? from_port && from_starboard : from_port || from_starboard;
  }

 private:
  // Nought at +-pi/2, where the rounded cosine would leave out the zenith itself.
  static double cos_elevation(double elevation) { return std::abs(elevation) < pi / 2 ? std::cos(elevation) : 0; }

  bool whole_circle_, convex_;
  Eigen::Vector2d port_, starboard_;  // inward normals of the edges in azimuth
  Eigen::Vector2d top_, bottom_;      // sine and cosine of the edges in elevation
};

struct Gate {
  const SceneCloud& scene;
  const HeadFrame& head;
  SectorTest sector;
  RangeGate range;
  double footprint;

  void add_if_inside(std::size_t i, std::vector<GatedSurfel>& inside) const {
    const Vector3d p = head.position(scene.point[i]);
    const double r2 = p.squaredNorm();
    if (!(r2 <= range.max_range * range.max_range) || r2 < nothing_nearer * nothing_nearer) return;
    const double spacing = std::sqrt(static_cast<double>(scene.area[i])), radius = footprint * spacing;
    if (!sector.holds(p, radius)) return;

    const double r = std::sqrt(r2);
    const Vector3d normal = head.direction(scene.normal[i].cast<double>());
    const double along = normal.dot(p);  // negative: the normal points back to the head
    GatedSurfel s{};
    s.position = p.cast<float>();
    s.range = static_cast<float>(r);
    s.away = (along < 0 ? Vector3d(-normal) : normal).cast<float>();
    s.plane_distance = static_cast<float>(std::abs(along));
    s.radius = static_cast<float>(radius);
    s.spacing = static_cast<float>(spacing);
    s.surfel = static_cast<std::uint32_t>(i);
    s.in_gate = r >= range.min_range && sector.holds(p, 0);
    s.facing = scene.normals_oriented ? along < 0 : along != 0;
    inside.push_back(s);
  }
};

}  // namespace

std::vector<GatedSurfel> gate_surfels(const SceneCloud& scene, const HeadFrame& head, const Sector& sector,
                                      const RangeGate& range, double footprint, int threads) {
  const Gate gate{scene, head, SectorTest(sector), range, footprint};
  constexpr std::size_t block = 1 << 15;
  std::vector<std::vector<GatedSurfel>> parts((scene.size() + block - 1) / block);
  parallel_blocks(scene.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) gate.add_if_inside(i, parts[begin / block]);
  });
  std::size_t total = 0;
  for (const auto& part : parts) total += part.size();
  std::vector<GatedSurfel> all;
  all.reserve(total);
  for (auto& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
  return all;
}

}  // namespace insonify
