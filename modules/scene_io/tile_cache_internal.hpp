// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

// Private to scene_io: tiles that were read, for the pings after.
namespace insonify {

/// Cache of the bytes of tiles, up to a limit. It drops the least recently used first. Several threads may use it.
class TileCache {
 public:
  using Bytes = std::shared_ptr<const std::vector<char>>;

  /// Keeps at most `most_bytes`; 0: nothing.
  explicit TileCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Returns the bytes of a tile from the cache, or else from `read`, whose errors propagate.
  Bytes get(std::uint32_t tile, const std::function<std::vector<char>()>& read);

  std::uint64_t reads() const;     ///< number of calls of `read`
  std::size_t kept_bytes() const;  ///< at most the limit

 private:
  struct Kept {
    std::uint32_t tile;
    Bytes bytes;
  };
  void keep(std::uint32_t tile, const Bytes& bytes);

  mutable std::mutex guard_;
  std::size_t most_bytes_, kept_bytes_ = 0;
  std::uint64_t reads_ = 0;
  std::list<Kept> by_use_;  ///< the last used in front
  std::unordered_map<std::uint32_t, std::list<Kept>::iterator> place_;
};

}  // namespace insonify
