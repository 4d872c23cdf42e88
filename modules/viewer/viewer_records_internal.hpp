// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "view/ping_record.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify {

/// One beam in some consecutive pings, kept until others are requested.
struct BeamPage {
  std::size_t first = 0, count = 0, beam = 0;
  ComplexGridF pressure;  ///< pings x bins [Pa]

  std::size_t end() const { return first + count; }
};

/// Sets `page` to these pings. Reads them unless it holds them already.
void turn_page(BeamPage& page, const LazyPings& pings, std::size_t first, std::size_t count, std::size_t beam);

/// First index and number of the pings of the waterfall that shows a ping: at most 600 of them.
struct PageOfPings {
  std::size_t first = 0, count = 0;
};
PageOfPings page_of(const LazyPings& pings, std::size_t ping);

/// Returns the levels of a page, range compensated if `tvg`.
BeamRecord record_of(const ViewerData& data, const BeamPage& page, bool tvg);

/// Returns the display of a scanning head of one beam at a ping, with indices of pings in the reel.
SweepImage sweep_at(const ViewerData& data, std::size_t ping, bool tvg, BeamPage& page);

}  // namespace insonify
