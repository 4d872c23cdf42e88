// SPDX-License-Identifier: BSD-3-Clause
#include "tool/export/sounding_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace insonify::tool {
namespace {

constexpr double deviations_of_tvu = 1.959963985;

/// Returns the radius that holds 95 % of a normal distribution in the plane with these deviations along its axes [m]
/// (E214).
double radius_of_95(double larger, double smaller) {
  if (!(larger > 0)) return 0;
  const double ratio = smaller / larger;
  return larger * (1.960790 + ratio * (0.004071 + ratio * (0.114276 + ratio * 0.371625)));
}

/// Displacements of a sounding for one deviation of each source; a source has one for each independent part. (E214)
struct Displacements {
  std::array<std::vector<Eigen::Vector3d>, uncertainty_terms.size()> of;
};

Displacements displacements_of(const SoundingGeometry& s, const InstrumentDeviations& d) {
  const Eigen::Vector3d &v = s.from_vehicle, &h = s.from_head;
  const double across = std::hypot(h.x(), h.y()), depth = h.z(), speed = s.sound_speed;
  const Eigen::Vector3d outward =
      across > 0 ? Eigen::Vector3d(h.x() / across, h.y() / across, 0) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d down(0, 0, 1);
  Displacements m;
  m.of[0] = {s.range_deviation * h.normalized()};
  m.of[1] = {d.attitude * Eigen::Vector3d(0, -v.z(), v.y()), d.attitude * Eigen::Vector3d(v.z(), 0, -v.x())};
  m.of[2] = {d.heading * Eigen::Vector3d(-v.y(), v.x(), 0)};
  m.of[3] = {d.position * Eigen::Vector3d::UnitX(), d.position * Eigen::Vector3d::UnitY()};
  m.of[4] = {d.height * down};
  m.of[5] = {d.latency * s.velocity};
  // A profile that is off by the same speed everywhere changes the length of the ray and, by Snell's law, its angle.
  m.of[6] = {d.sound_speed / speed * (2 * across * outward + (depth - across * across / depth) * down)};
  // Beams of a line array are steered by delays, so the sine of their angle goes with the sound speed at the head.
  const double turn = d.surface_sound_speed / speed * std::tan(s.steering);
  m.of[7] = {turn * Eigen::Vector3d(0, h.z(), -h.y())};
  return m;
}

}  // namespace

SoundingUncertainty uncertainty_of(const SoundingGeometry& sounding, const InstrumentDeviations& instruments) {
  const Displacements displacements = displacements_of(sounding, instruments);
  SoundingUncertainty result;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < displacements.of.size(); ++k) {
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& moved : displacements.of[k])
      variance += moved.cwiseAbs2(), covariance += moved * moved.transpose();
    result.terms[k] = variance.cwiseSqrt();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance.topLeftCorner<2, 2>(), Eigen::EigenvaluesOnly);
  result.vertical = std::sqrt(covariance(2, 2));
  result.tvu = deviations_of_tvu * result.vertical;
  result.thu =
      radius_of_95(std::sqrt(std::max(0.0, axes.eigenvalues()[1])), std::sqrt(std::max(0.0, axes.eigenvalues()[0])));
  return result;
}

RunUncertainty::RunUncertainty(const PlacedRun& run) : run_(run) {
  std::vector<std::string> notes;  // those of the product itself say the same
  if (known()) way_ = way_of(run.pings, notes);
}

SoundingUncertainty RunUncertainty::at(const Ping& ping, const BottomSoundings& found, std::size_t i) const {
  const ShipAxes ship = ship_axes(run_.pings, ping);
  const Eigen::Vector3d head = ping.world_from_head.translation();
  const Eigen::Vector3d vehicle = vehicle_pose(run_.pings, ping).value_or(ping.world_from_head).translation();
  const auto level = [&](const Eigen::Vector3d& world) {
    return Eigen::Vector3d(world.dot(ship.ahead), world.dot(ship.starboard), -world.z());
  };
  SoundingGeometry sounding;
  sounding.from_head = level(found.position[i] - head), sounding.from_vehicle = level(found.position[i] - vehicle);
  if (way_ && ping.time >= way_->time.front() && ping.time <= way_->time.back()) {
    const Motion motion = motion_at(*way_, ping.time);
    sounding.velocity = level(motion.velocity + motion.turn_rate.cross(found.position[i] - vehicle));
  }
  sounding.range_deviation = static_cast<double>(found.deviation[i]);
  sounding.steering = -ping.fan.azimuth[found.beam[i]];
  sounding.sound_speed = ping.sound_speed;
  return uncertainty_of(sounding, *run_.pings.instruments);
}

std::vector<std::string> uncertainty_columns() {
  std::vector<std::string> columns = {"tvu_m", "thu_m"};
  for (const char* term : uncertainty_terms)
    for (const char* direction : {"_vertical_m", "_horizontal_m"}) columns.push_back(term + std::string(direction));
  return columns;
}

std::vector<double> uncertainty_numbers(const SoundingUncertainty& uncertainty) {
  std::vector<double> numbers = {uncertainty.tvu, uncertainty.thu};
  for (const Eigen::Vector3d& term : uncertainty.terms)
    numbers.insert(numbers.end(), {term.z(), term.head<2>().norm()});
  return numbers;
}

}  // namespace insonify::tool
