// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "scene_io/tile_cache_internal.hpp"

namespace insonify {

TileCache::Bytes TileCache::get(std::uint32_t tile, const std::function<std::vector<char>()>& read) {
  {
    const std::scoped_lock lock(guard_);
    if (const auto found = place_.find(tile); found != place_.end()) {
      by_use_.splice(by_use_.begin(), by_use_, found->second);
      return found->second->bytes;
    }
    ++reads_;
  }
  // Outside of the lock, so that threads read side by side; two that miss the same tile both read it.
  Bytes bytes = std::make_shared<const std::vector<char>>(read());
  const std::scoped_lock lock(guard_);
  keep(tile, bytes);
  return bytes;
}

void TileCache::keep(std::uint32_t tile, const Bytes& bytes) {
  if (bytes->size() > most_bytes_ || place_.contains(tile)) return;
  by_use_.push_front({tile, bytes});
  place_[tile] = by_use_.begin();
  for (kept_bytes_ += bytes->size(); kept_bytes_ > most_bytes_; by_use_.pop_back()) {
    kept_bytes_ -= by_use_.back().bytes->size();
    place_.erase(by_use_.back().tile);
  }
}

std::uint64_t TileCache::reads() const {
  const std::scoped_lock lock(guard_);
  return reads_;
}

std::size_t TileCache::kept_bytes() const {
  const std::scoped_lock lock(guard_);
  return kept_bytes_;
}

}  // namespace insonify
