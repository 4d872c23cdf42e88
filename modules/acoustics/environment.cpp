// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/environment.hpp"

#include <algorithm>
#include <cmath>

#include "acoustics/boundary_count.hpp"
#include "acoustics/noise.hpp"
#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

void require_valid(const SeaSurface& s, const char* who) {
  const double rms = s.rms_height.value_or(0), strength = s.scattering_strength_db.value_or(0);
  require(std::isfinite(s.height), who, "surface.height", s.height, "m", "finite");
  require(rms >= 0 && std::isfinite(rms), who, "surface.rms_height", rms, "m", "finite and >= 0");
  require(strength <= 10 && std::isfinite(strength), who, "surface.scattering_strength_db", strength, "dB",
          "finite and at most 10");
}

void require_valid(const FlatBottom& b, const char* who) {
  const double mu = b.lambert_mu.value_or(0);
  require(std::isfinite(b.height), who, "bottom.height", b.height, "m", "finite");
  require(b.density_ratio > 0 && b.density_ratio < 100, who, "bottom.density_ratio", b.density_ratio, "",
          "> 0 and below 100");
  require(b.sound_speed_ratio > 0 && b.sound_speed_ratio < 100, who, "bottom.sound_speed_ratio", b.sound_speed_ratio,
          "", "> 0 and below 100");
  require(b.loss >= 0 && b.loss < 1, who, "bottom.loss", b.loss, "", ">= 0 and below 1");
  require(b.rms_height >= 0 && std::isfinite(b.rms_height), who, "bottom.rms_height", b.rms_height, "m",
          "finite and >= 0");
  require(mu >= 0 && mu <= 1 / pi, who, "bottom.lambert_mu", mu, "1/sr", "within 0 and 1/pi");
}

constexpr double depth_steps = 1000;      // [1/m]
constexpr double depths_agree_to = 0.01;  // [m]

bool varies(const SoundSpeedProfile& profile) {
  const auto [slowest, fastest] = std::minmax_element(profile.sound_speed.begin(), profile.sound_speed.end());
  return *slowest != *fastest;
}

}  // namespace

void require_valid(const Environment& e, const char* who) {
  require_valid(e.water, who);
  if (e.profile) require_valid(*e.profile, who);
  if (e.surface) require_valid(*e.surface, who);
  if (e.bottom) require_valid(*e.bottom, who);
  if (e.surface && e.bottom && !(e.bottom->height < e.surface->height))
    fail(ErrorKind::argument, who, ": bottom.height = ", e.bottom->height,
         " m, must be below surface.height = ", e.surface->height, " m");
  require(std::isfinite(e.water_level.value_or(0)), who, "water.level", e.water_level.value_or(0), "m", "finite");
  if (e.surface && e.water_level && !(std::abs(*e.water_level - e.surface->height) <= depths_agree_to))
    fail(ErrorKind::argument, who, ": water.level_m = ", *e.water_level,
         " m, must be that of surface.height_m = ", e.surface->height, " m to 0.01 m; leave one of them out");
  require(e.mirrors.size() <= most_mirrors, who, "number of mirrors", static_cast<double>(e.mirrors.size()), "",
          "at most 57: the time of a ping grows with the cube of the number of planes");
  for (const Mirror& mirror : e.mirrors) require_valid(mirror, who);
  if (e.tank) require_valid(*e.tank, who);
  if (e.tank && (e.surface || e.bottom || e.water_level))
    fail(ErrorKind::argument, who,
         ": a tank has a surface and a floor of its own; leave surface, bottom and water.level ", "out");
  const double volume = e.volume_scattering_db.value_or(-70), self = e.self_noise_db.value_or(0);
  const double wind = e.wind_speed.value_or(0);
  require(volume <= 0 && std::isfinite(volume), who, "volume.scattering_db", volume, "dB", "finite and at most 0");
  require(wind >= 0 && wind <= 100, who, "wind_speed", wind, "m/s", "within 0 and 100");
  require(std::abs(self) <= 400, who, "self_noise_db", self, "dB re 1 uPa^2/Hz", "within -400 and 400");
}

std::vector<Mirror> mirrors_of(const Environment& e) {
  std::vector<Mirror> all = e.mirrors;
  if (e.tank)
    for (Mirror& plane : mirrors_of(*e.tank)) all.push_back(std::move(plane));
  return all;
}

std::optional<double> surface_height(const Environment& e) {
  if (e.tank) return e.tank->corner.z() + e.tank->size.z();
  return e.surface ? std::optional(e.surface->height) : e.water_level;
}

double head_depth(const Environment& e, double head_height) {
  const auto surface = surface_height(e);
  return surface ? std::round((*surface - head_height) * depth_steps) / depth_steps : e.water.depth;
}

void require_depths_known(const Environment& e, const char* who) {
  if (e.profile && !surface_height(e) && varies(*e.profile))
    fail(ErrorKind::argument, who, ": the sound-speed profile counts depth from the surface of the water, must come ",
         "with its height in the world: give surface.height_m, e.g. --set surface.height_m=0, or water.level_m, which ",
         "has no echoes of its own");
}

Environment environment_at(const Environment& e, double head_height, const char* who) {
  require_valid(e, who);
  require_depths_known(e, who);
  Environment there = e;
  there.water.depth = head_depth(e, head_height);
  const auto surface = surface_height(e);
  if (!surface) return there;
  if (!(there.water.depth > 0))
    fail(ErrorKind::argument, who, ": the head is at height z = ", head_height,
         " m, must be below the surface of the water, surface.height = ", *surface,
         " m; lower the head, or give the surface the height it has in the frame of the scene (surface.height_m)");
  if (e.water.depth > 0 && std::abs(e.water.depth - there.water.depth) > depths_agree_to)
    fail(ErrorKind::argument, who, ": water.depth = ", e.water.depth, " m, but the head at z = ", head_height, " m is ",
         there.water.depth, " m below surface.height = ", *surface,
         " m, must agree to 0.01 m; leave water.depth_m out: with a surface depth follows from where the head is");
  return there;
}

double slowest_sound(const Environment& e) {
  if (e.profile && (surface_height(e) || !varies(*e.profile)))
    return *std::min_element(e.profile->sound_speed.begin(), e.profile->sound_speed.end());
  Water water = e.water;
  if (surface_height(e)) water.depth = 0;
  return e.profile ? sound_speed_at(*e.profile, water.depth) : sound_speed(water, e.sound_speed_formula);
}

Medium medium_of(const Environment& e, double centre_frequency, int absorption_order) {
  Medium medium = medium_of(e.water, centre_frequency, absorption_order, e.absorption_formula);
  medium.sound_speed =
      e.profile ? sound_speed_at(*e.profile, e.water.depth) : sound_speed(e.water, e.sound_speed_formula);
  return medium;
}

double element_noise_level_db(const Environment& e, const Pulse& pulse) {
  require_valid(e, "element_noise_level_db");
  const double thermal_db = thermal_noise_level_db(pulse), f = pulse.centre_frequency;
  if (!e.wind_speed && !e.self_noise_db) return thermal_db;
  const double band_db = thermal_db - thermal_noise_spectrum_level_db(f);
  double power = power_from_db(thermal_db);
  if (e.wind_speed) power += power_from_db(wind_noise_spectrum_level_db(f, *e.wind_speed) + band_db);
  if (e.self_noise_db) power += power_from_db(*e.self_noise_db + band_db);
  return db_from_power(power);
}

}  // namespace insonify
