// SPDX-License-Identifier: BSD-3-Clause
#include "files/utc.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/text.hpp"

namespace insonify {
namespace {

constexpr double seconds_since_1970(int year, unsigned month, unsigned day) {
  using namespace std::chrono;
  const sys_days date(year_month_day{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)});
  return 86400.0 * static_cast<double>(date.time_since_epoch().count());
}

/// Starts of the days before which a second was put in, since GPS time began (IERS, leap-seconds.list of 2025-07-07).
constexpr double leap_days[] = {
    seconds_since_1970(1981, 7, 1), seconds_since_1970(1982, 7, 1), seconds_since_1970(1983, 7, 1),
    seconds_since_1970(1985, 7, 1), seconds_since_1970(1988, 1, 1), seconds_since_1970(1990, 1, 1),
    seconds_since_1970(1991, 1, 1), seconds_since_1970(1992, 7, 1), seconds_since_1970(1993, 7, 1),
    seconds_since_1970(1994, 7, 1), seconds_since_1970(1996, 1, 1), seconds_since_1970(1997, 7, 1),
    seconds_since_1970(1999, 1, 1), seconds_since_1970(2006, 1, 1), seconds_since_1970(2009, 1, 1),
    seconds_since_1970(2012, 7, 1), seconds_since_1970(2015, 7, 1), seconds_since_1970(2017, 1, 1)};

}  // namespace

int leap_seconds_of_gps(double utc) {
  return static_cast<int>(std::upper_bound(std::begin(leap_days), std::end(leap_days), utc) - std::begin(leap_days));
}

double gps_time_of_utc(double utc) { return utc - seconds_since_1970(1980, 1, 6) + leap_seconds_of_gps(utc); }

std::string utc_after(const std::string& start, double seconds) {
  using namespace std::chrono;
  int y = 0, month_number = 0, day_number = 0, h = 0, min = 0, read = 0;
  double s = 0;
  const bool whole = std::sscanf(start.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%n", &y, &month_number, &day_number, &h, &min,
                                 &s, &read) == 6 &&
                     start.substr(static_cast<std::size_t>(read)) == "Z";
  const year_month_day date{year{y}, month{static_cast<unsigned>(month_number)},
                            day{static_cast<unsigned>(day_number)}};
  if (!whole || !date.ok() || h < 0 || h > 23 || min < 0 || min > 59 || !(s >= 0 && s < 61) || !std::isfinite(seconds))
    fail(ErrorKind::argument, "utc_after: '", start, "' and ", seconds,
         " s after it, must be a time of UTC like 2026-05-01T08:30:00Z and finite");
  const auto milliseconds_after = milliseconds(std::llround(1000 * (s + seconds)));
  const auto then = sys_days{date} + hours{h} + minutes{min} + milliseconds_after;
  const auto its_day = floor<days>(then);
  const year_month_day its_date{its_day};
  const hh_mm_ss clock{then - its_day};
  return printed("%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(its_date.year()),
                 static_cast<unsigned>(its_date.month()), static_cast<unsigned>(its_date.day()),
                 static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                 static_cast<int>(clock.seconds().count()), static_cast<int>(clock.subseconds().count()));
}

}  // namespace insonify
