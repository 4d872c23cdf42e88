// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/random.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"

namespace insonify {

// 70 beams: one full chunk of 64 and a partial one.
inline Cube random_cube(std::size_t pings = 3, std::size_t beams = 70) {
  Cube cube;
  cube.sound_speed = 1489.8;
  cube.absorption_db_per_m = 0.2994626;
  cube.centre_frequency = 900e3, cube.bandwidth = 29.5e3;
  cube.source_level_db = 220;
  cube.seed = 18446744073709551557u;  // does not fit into a signed number or a double
  cube.tolerance = 1e-4;
  cube.sonar = "p900-45";
  cube.insonify_version = "0.1.0";
  const BeamFan fan = make_fan(beams, radians(45), radians(1), radians(20), radians(-3));
  const RangeGate gate = {2, 2.5, 0.011};
  for (std::size_t p = 0; p < pings; ++p) {
    Ping ping;
    ping.number = static_cast<std::int64_t>(p) + 40;
    ping.time = 0.1 * static_cast<double>(p);
    ping.world_from_head = pose_from_yaw_pitch_roll({1.0 + static_cast<double>(p), 2, -3}, 0.3, 0.2, 0.1);
    ping.fan = fan;
    ping.gate = gate;
    ping.pressure.resize(static_cast<Eigen::Index>(beams), static_cast<Eigen::Index>(gate.bins()));
    for (Eigen::Index b = 0; b < ping.pressure.rows(); ++b)
      for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n)
        ping.pressure(b, n) = std::complex<float>(random_complex_normal(
            1, RandomStage::noise, {p, static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(n)}));
    cube.pings.push_back(ping);
  }
  return cube;
}

inline std::string write(const Cube& cube, const std::string& name = "cube.h5") {
  const std::string path = own_path(name);
  write_cube(path, cube);
  return path;
}

inline std::string error_of_cube(const std::string& path) {
  return replaced(error_with_kind([&] { read_cube(path); }), path, "cube.h5");
}

}  // namespace insonify
