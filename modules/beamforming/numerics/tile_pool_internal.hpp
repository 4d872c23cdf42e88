// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace insonify {

/// A pool of working memory for reuse, because allocating it costs more than clearing it. Threads may share a pool.
template <typename Tile>
class TilePool {
 public:
  explicit TilePool(std::function<std::unique_ptr<Tile>()> make) : make_(std::move(make)) {}

  /// Returns an idle tile with its last contents, or a new tile.
  std::unique_ptr<Tile> take() {
    {
      const std::scoped_lock lock(guard_);
      if (!idle_.empty()) {
        auto tile = std::move(idle_.back());
        idle_.pop_back();
        return tile;
      }
    }
    return make_();
  }
  /// Keeps a tile for later. One that an error has left half filled is not given back.
  void give(std::unique_ptr<Tile> tile) {
    const std::scoped_lock lock(guard_);
    idle_.push_back(std::move(tile));
  }

 private:
  std::function<std::unique_ptr<Tile>()> make_;
  std::mutex guard_;
  std::vector<std::unique_ptr<Tile>> idle_;
};

}  // namespace insonify
