// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/boundary_count.hpp"
#include "acoustics/boundary_internal.hpp"
#include "acoustics/reflection.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double on_the_plane = 1e-3;  // [m]: a head nearer than this stands on it

}  // namespace

bool Boundary::within_edges(const Vector3d& position) const {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3d side = corners[(k + 1) % corners.size()] - corners[k];
    const Vector3d inward = normal.cross(side).normalized();
    if (inward.dot(position - corners[k]) < -on_the_plane) return false;
  }
  return true;
}

std::complex<double> Boundary::reflection(double grazing) const {
  const double left = coherent_reflection_loss(wavenumber, rms_height, grazing);
  if (bottom) return left * bottom_reflection(*bottom, grazing);
  if (!mirror) return -left;
  if (!mirror->solid) return left * mirror->reflection;
  return left * reflection_coefficient(*mirror->solid, std::sin(grazing), sea_water_density, sound_speed);
}

std::complex<double> Boundary::edges(const Vector3d& image) const {
  if (corners.empty()) return 1;
  const double crossing = head_distance / (head_distance - distance(image));
  return aperture_factor(counterclockwise(fresnel_corners(corners, image, crossing, wavenumber)));
}

double Boundary::strongest_bounce(double range) const {
  const double sine = std::min(1.0, std::abs(head_distance) / range);
  return coherent_reflection_loss(wavenumber, rms_height, std::asin(sine));
}

double pulse_margin(const Transmission& sent) {
  return 0.5 * sent.medium.sound_speed * pulse_half_length(sent.pulse, pulse_floor);
}

std::complex<double> one_way_pattern(const EchoOptions& options, double v) {
  const double two_way = elevation_pattern(options, std::asin(std::clamp(v, -1.0, 1.0)));
  return two_way < 0 ? std::complex<double>(0, std::sqrt(-two_way)) : std::complex<double>(std::sqrt(two_way), 0);
}

Eigen::Matrix<double, 3, 2> across_way(const Vector3d& end) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = end.unitOrthogonal();
  across.col(1) = across.col(0).cross(end.normalized());
  return across;
}

double fresnel_scale(double length, double crossing, double wavenumber) {
  return std::sqrt(wavenumber / (pi * length * crossing * (1 - crossing)));
}

ConvexPolygon fresnel_corners(std::span<const Vector3d> corners, const Vector3d& end, double crossing,
                              double wavenumber) {
  const Eigen::Matrix<double, 3, 2> across = across_way(end);
  const double scale = fresnel_scale(end.norm(), crossing, wavenumber);
  ConvexPolygon polygon;
  polygon.reserve(corners.size());
  for (const Vector3d& corner : corners) polygon.emplace_back(scale * across.transpose() * (corner - crossing * end));
  return polygon;
}

std::vector<Boundary> boundaries_of(const Environment& environment, const Pose& world_from_head,
                                    const Transmission& transmission, double tolerance, const char* who) {
  if (!environment.surface && !environment.bottom)
    fail(ErrorKind::argument, who, ": environment has neither surface nor bottom, must have one of them");
  const double head = world_from_head.translation().z();
  const double wavenumber = 2 * pi * transmission.pulse.centre_frequency / transmission.medium.sound_speed;
  std::vector<Boundary> boundaries;
  const auto add = [&](double height, double water_side, double rms_height, const FlatBottom* bottom) {
    const Vector3d into_water = water_side * Vector3d::UnitZ();
    Boundary& b = boundaries.emplace_back();
    b.plane = MirrorPlane(into_water, -water_side * height);
    b.normal = world_from_head.linear().transpose() * into_water;
    b.head_distance = water_side * (head - height);
    b.rms_height = rms_height, b.thickness = tolerance + 3 * rms_height;
    b.wavenumber = wavenumber, b.sound_speed = transmission.medium.sound_speed;
    b.bottom = bottom, b.ends_water = !bottom;
    if (!(b.head_distance > 0))
      fail(ErrorKind::argument, who, ": the head stands at height ", head, " m, must be ",
           bottom ? "above bottom.height = " : "below surface.height = ", height, " m");
  };
  if (environment.surface) add(environment.surface->height, -1, rms_wave_height(environment), nullptr);
  if (environment.bottom) add(environment.bottom->height, 1, environment.bottom->rms_height, &*environment.bottom);
  return boundaries;
}

std::vector<Boundary> boundaries_of(std::span<const Mirror> mirrors, const Pose& world_from_head,
                                    const Transmission& transmission, const char* who) {
  const Pose to_head = world_from_head.inverse();
  std::vector<Boundary> boundaries;
  for (const Mirror& mirror : mirrors) {
    Boundary b;
    b.plane = MirrorPlane(mirror.normal.normalized(), mirror.position);
    b.normal = to_head.linear() * b.plane.normal();
    b.head_distance = b.plane.signedDistance(world_from_head.translation());
    b.rms_height = mirror.rms_height, b.thickness = mirror.thickness + 3 * mirror.rms_height;
    b.wavenumber = 2 * pi * transmission.pulse.centre_frequency / transmission.medium.sound_speed;
    b.sound_speed = transmission.medium.sound_speed;
    b.mirror = &mirror, b.ends_water = mirror.corners.empty();
    for (const Vector3d& corner : mirror.corners) b.corners.push_back(to_head * corner);
    if (std::abs(b.head_distance) < on_the_plane && b.within_edges(Vector3d::Zero()))
      fail(ErrorKind::argument, who, ": the head stands on mirror '", mirror.name, "', ", b.head_distance,
           " m from its plane, must be at least ", on_the_plane, " m in front of it");
    if (b.head_distance < 0 && b.ends_water)
      fail(ErrorKind::argument, who, ": the head stands ", -b.head_distance, " m behind mirror '", mirror.name,
           "', must be in front of it: its normal points into the water, and it has no edges");
    if (b.head_distance >= on_the_plane) boundaries.push_back(std::move(b));
  }
  if (boundaries.size() > most_boundaries)
    fail(ErrorKind::argument, who, ": ", boundaries.size(), " mirrors face the head, must be at most ", most_boundaries,
         "; declare fewer, or fewer smooth materials");
  return boundaries;
}

}  // namespace insonify
