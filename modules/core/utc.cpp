#include "core/utc.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/text.hpp"

namespace insonify {

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
