// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "support/test.hpp"
#include "viewer/three_targets.hpp"
#include "viewer/viewer_records_internal.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace insonify {

inline constexpr std::size_t pings_per_sweep = 12;

/// Returns ping i of a head of one beam. Its level at bin b grows by a decibel for each ping, and by 20 at bin i.
inline Ping one_beam_ping(std::size_t i, bool scans) {
  Ping ping;
  ping.number = static_cast<std::int64_t>(i);
  ping.time = 0.5 * static_cast<double>(i);
  ping.world_from_head = pose_from_yaw_pitch_roll({0.1 * static_cast<double>(i), 0, -3}, 0, 0, 0);
  if (scans)
    ping.scan = ScanDirection{static_cast<std::int64_t>(i / pings_per_sweep),
                              radians(30.0 * static_cast<double>(i % pings_per_sweep))};
  ping.fan = make_fan(1, 0, radians(2), radians(20));
  ping.gate = {1, 9, 0.1};
  ping.pressure = ComplexGridF::Constant(1, 80, std::pow(10.0F, static_cast<float>(i) / 20));
  ping.pressure(0, static_cast<Eigen::Index>(i % 80)) *= 10;
  return ping;
}

/// A reel that counts its reads, and the pings held at once.
struct CountedReel {
  std::shared_ptr<int> read = std::make_shared<int>(0), beams_read = std::make_shared<int>(0);

  LazyPings reel(std::size_t count, bool scans) const {
    std::vector<TrackPoint> positions;
    for (std::size_t i = 0; i < count; ++i) {
      const Ping ping = one_beam_ping(i, scans);
      positions.push_back({ping.number, ping.time, ping.world_from_head, ping.scan});
    }
    PingSource source;
    source.ping = [scans, read = read](std::size_t i) { return ++*read, one_beam_ping(i, scans); };
    source.beam = [scans, rows_read = beams_read](std::size_t first, std::size_t n, std::size_t beam) {
      *rows_read += static_cast<int>(n);
      ComplexGridF rows(static_cast<Eigen::Index>(n), 80);
      for (std::size_t i = 0; i < n; ++i)
        rows.row(static_cast<Eigen::Index>(i)) =
            one_beam_ping(first + i, scans).pressure.row(static_cast<Eigen::Index>(beam));
      return rows;
    };
    return {std::move(positions), std::move(source)};
  }
};

/// Returns a return at a place of its own, of ping i.
inline Soundings one_return(std::size_t i) {
  Soundings one;
  one.position = {{0.5 * static_cast<double>(i), 0, 0.1}};
  one.level_db = {120}, one.range = {3}, one.azimuth = {0}, one.elevation = {0};
  one.ping = {static_cast<std::uint32_t>(i)}, one.beam = {0}, one.bin = {0};
  one.true_elevation = {0}, one.true_surfel = {Soundings::none}, one.true_material = {Soundings::none};
  return one;
}

/// A window of a survey of one beam, off the screen.
class SurveyWindow : public testing::Test {
 protected:
  void open(std::size_t pings, bool scans) {
    data_.title = "survey";
    data_.pings = counted_.reel(pings, scans);
    ViewerOptions options;
    options.width = 800, options.height = 600;
    options.say = [this](const std::string& text) { said_.push_back(text); };
    window_ = std::make_unique<ViewerWindow>(data_, options, ViewerScreen::off_screen);
    window_->run({});
  }
  void click(Point2 at) { window_->click(at); }

  CountedReel counted_;
  ViewerData data_;
  std::unique_ptr<ViewerWindow> window_;
  std::vector<std::string> said_;
};

}  // namespace insonify
