#pragma once
#include <optional>

#include "acoustics/bend_paths.hpp"

namespace insonify {

/// find_eigenray for a valid profile and finite arguments, horizontal >= 0; none in a shadow zone.
std::optional<Eigenray> eigenray_between(const SoundSpeedProfile& profile, double depth_from, double depth_to,
                                         double horizontal);

}  // namespace insonify
