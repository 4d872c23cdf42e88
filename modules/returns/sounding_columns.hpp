#pragma once
#include "returns/soundings.hpp"

namespace insonify {

/// Calls use(name, column ...) for every column beside position, in the order of files, with the columns of one or more
/// soundings.
template <typename Use, typename... Some>
void each_column(const Use& use, Some&... soundings) {
  use("level_db", soundings.level_db...);
  use("range", soundings.range...);
  use("azimuth", soundings.azimuth...);
  use("elevation", soundings.elevation...);
  use("ping", soundings.ping...);
  use("beam", soundings.beam...);
  use("bin", soundings.bin...);
  use("material", soundings.material...);
}

}  // namespace insonify
