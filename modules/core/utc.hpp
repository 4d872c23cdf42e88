#pragma once
#include <string>

namespace insonify {

/// The time `seconds` after `start` (UTC like "2026-05-01T08:30:00Z", perhaps with fractions of the second) in the same form
/// with milliseconds; days have 86400 s. Throws Error(argument) unless `start` is such a time.
std::string utc_after(const std::string& start, double seconds);

}  // namespace insonify
