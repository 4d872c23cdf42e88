// SPDX-License-Identifier: BSD-3-Clause
#include "returns/quantise.hpp"

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace insonify {
namespace {

void require_valid(const GreyWindow& w, const char* who) {
  if (!std::isfinite(w.min_db) || !std::isfinite(w.max_db) || !(w.min_db < w.max_db))
    fail(ErrorKind::argument, who, ": window from min_db = ", w.min_db, " to max_db = ", w.max_db,
         " dB, must be finite with min_db below max_db");
}

template <typename Grey>
Grid<Grey> quantised(const Grid<float>& level_db, const GreyWindow& w, const char* who) {
  require_valid(w, who);
  constexpr double most = std::numeric_limits<Grey>::max();
  Grid<Grey> grey(level_db.rows(), level_db.cols());
  for (Eigen::Index b = 0; b < grey.rows(); ++b)
    for (Eigen::Index n = 0; n < grey.cols(); ++n) {
      const double level = level_db(b, n);
      if (std::isnan(level)) fail(ErrorKind::content, who, ": level(", b, ", ", n, ") is not a number");
      const double step = std::round((level - w.min_db) / (w.max_db - w.min_db) * most);  // (E58)
      grey(b, n) = static_cast<Grey>(step <= 0 ? 0 : step < most ? step : most);
    }
  return grey;
}

}  // namespace

double gain_db(const Tvg& tvg, double range) {
  return tvg.spreading * std::log10(range) + 2 * tvg.absorption_db_per_m * range;  // (E20)
}

Grid<float> apply_tvg(Grid<float> level_db, const RangeGate& gate, const Tvg& tvg, double floor_db) {
  if (static_cast<std::size_t>(level_db.cols()) != gate.bins())
    fail(ErrorKind::argument, "apply_tvg: levels of ", level_db.cols(), " bins, but the gate has ", gate.bins());
  if (!std::isfinite(tvg.spreading) || !std::isfinite(tvg.absorption_db_per_m))
    fail(ErrorKind::argument, "apply_tvg: spreading = ", tvg.spreading,
         " dB per decade, absorption_db_per_m = ", tvg.absorption_db_per_m, " dB/m, must be finite");
  Eigen::Array<float, 1, Eigen::Dynamic> gain(level_db.cols());
  for (Eigen::Index n = 0; n < gain.size(); ++n)
    gain[n] = static_cast<float>(gain_db(tvg, gate.centre(static_cast<std::size_t>(n))));
  for (Eigen::Index b = 0; b < level_db.rows(); ++b)
    level_db.row(b) = (level_db.row(b) > static_cast<float>(floor_db)).select(level_db.row(b) + gain, level_db.row(b));
  return level_db;
}

Grid<std::uint8_t> quantise_8(const Grid<float>& level_db, const GreyWindow& window) {
  return quantised<std::uint8_t>(level_db, window, "quantise_8");
}

Grid<std::uint16_t> quantise_16(const Grid<float>& level_db, const GreyWindow& window) {
  return quantised<std::uint16_t>(level_db, window, "quantise_16");
}

double level_of_grey(std::uint16_t value, int bits, const GreyWindow& w) {
  require_valid(w, "level_of_grey");
  if (bits != 8 && bits != 16) fail(ErrorKind::argument, "level_of_grey: bits = ", bits, ", must be 8 or 16");
  const int most = bits == 8 ? 255 : 65535;
  if (value > most) fail(ErrorKind::argument, "level_of_grey: value = ", value, ", must be at most ", most);
  return w.min_db + value * (w.max_db - w.min_db) / most;
}

}  // namespace insonify
