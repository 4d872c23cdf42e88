// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Returns the time `seconds` after `start` as text with milliseconds. `start` is UTC like "2026-05-01T08:30:00Z",
/// optionally with fractions of a second; days have 86400 s. Throws Error(argument) unless `start` is such a time.
std::string utc_after(const std::string& start, double seconds);

/// Returns the leap seconds by which GPS time is ahead of UTC at a time [s since 1970, days of 86400 s]: 0 before July
/// 1981, 18 from 2017 on. From the IERS's list of 2025-07-07, which holds until 2026-06-28; none was announced after
/// it.
int leap_seconds_of_gps(double utc);

/// Returns the GPS time [s since 1980-01-06], with leap seconds, of a UTC time [s since 1970, days of 86400 s].
double gps_time_of_utc(double utc);

}  // namespace insonify
