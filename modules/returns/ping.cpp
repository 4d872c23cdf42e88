// SPDX-License-Identifier: BSD-3-Clause
#include "returns/ping.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "core/vector_functions.hpp"

namespace insonify {
namespace {
constexpr std::size_t samples_per_block = 1 << 16, cells_per_block = 1 << 14;

[[noreturn]] void fail_as_too_loud(double pressure, const char* who) {
  fail(ErrorKind::content, who, ": pressure of up to ", pressure,
       " Pa, must be below the 3.4e38 of single precision; lower source level, areas or lambert_mu");
}
}  // namespace

void note_water(const Medium& at_head, Ping& ping) {
  ping.sound_speed = at_head.sound_speed;
  ping.absorption_db_per_m = at_head.absorption.a0 / nepers_per_db;
}

ComplexGridF stored_pressure(const ComplexGrid& pressure, const char* who) {
  ComplexGridF stored(pressure.rows(), pressure.cols());
  const auto* from = reinterpret_cast<const double*>(pressure.data());
  auto* to = reinterpret_cast<float*>(stored.data());
  std::atomic<bool> finite = true;
  parallel_blocks(2 * static_cast<std::size_t>(pressure.size()), samples_per_block, 0,
                  [&](std::size_t begin, std::size_t end) {
                    bool all = true;
                    for (std::size_t k = begin; k < end; ++k) {
                      to[k] = static_cast<float>(from[k]);
                      all &= std::abs(to[k]) <= std::numeric_limits<float>::max();
                    }
                    if (!all) finite = false;
                  });
  if (!finite) fail_as_too_loud(pressure.abs().maxCoeff(), who);
  return stored;
}

ComplexGridF stored_cells(const Grid<double>& intensity, const char* who) {
  ComplexGridF stored(intensity.rows(), intensity.cols());
  std::atomic<bool> finite = true;
  parallel_blocks(static_cast<std::size_t>(intensity.size()), cells_per_block, 0,
                  [&](std::size_t begin, std::size_t end) {
                    const auto count = static_cast<Eigen::Index>(end - begin);
                    Eigen::Map<Eigen::ArrayXcf> to(stored.data() + begin, count);
                    to = Eigen::Map<const Eigen::ArrayXd>(intensity.data() + begin, count).sqrt().cast<float>();
                    if (!to.real().isFinite().all()) finite = false;
                  });
  if (!finite) fail_as_too_loud(std::sqrt(intensity.maxCoeff()), who);
  return stored;
}

Grid<float> level_db(const Ping& ping, double floor_db) {
  const double unit = 2 * micropascal * micropascal, floor_power = std::max(1e-300, unit * power_from_db(floor_db));
  const auto level_of = [&](const std::complex<float>& p) {
    const double power = std::norm(std::complex<double>(p));
    if (!(power > floor_power)) return static_cast<float>(floor_db);
    return static_cast<float>(10 / std::numbers::ln10 * vec::log(power / unit));  // (E6)
  };
  Grid<float> level(ping.pressure.rows(), ping.pressure.cols());
  parallel_blocks(
      static_cast<std::size_t>(level.size()), samples_per_block, 0, [&](std::size_t begin, std::size_t end) {
        std::transform(ping.pressure.data() + begin, ping.pressure.data() + end, level.data() + begin, level_of);
      });
  return level;
}

Grid<float> range_compensated_level_db(const Ping& ping, double absorption_db_per_m, double floor_db) {
  Grid<float> level = level_db(ping, floor_db);
  for (Eigen::Index n = 0; n < level.cols(); ++n) {
    const double r = ping.gate.centre(static_cast<std::size_t>(n));
    const double gain = 40 * std::log10(r) + 2 * absorption_db_per_m * r;  // (E20)
    for (Eigen::Index b = 0; b < level.rows(); ++b)
      if (level(b, n) > static_cast<float>(floor_db)) level(b, n) += static_cast<float>(gain);
  }
  return level;
}

double mean_level_db(const Ping& ping, double min_range, double max_range) {
  double power = 0;
  std::size_t samples = 0;
  for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n) {
    const double r = ping.gate.centre(static_cast<std::size_t>(n));
    if (r < min_range || r > max_range) continue;
    for (Eigen::Index b = 0; b < ping.pressure.rows(); ++b)
      power += std::norm(std::complex<double>(ping.pressure(b, n)));
    samples += static_cast<std::size_t>(ping.pressure.rows());
  }
  return pressure_level_db(std::sqrt(power / static_cast<double>(std::max<std::size_t>(samples, 1))));
}

}  // namespace insonify
