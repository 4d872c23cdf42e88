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
  struct GiveBack {
    TilePool* pool;
    void operator()(Tile* tile) const { pool->give_back(std::unique_ptr<Tile>(tile)); }
  };
  using Handle = std::unique_ptr<Tile, GiveBack>;

  explicit TilePool(std::function<std::unique_ptr<Tile>()> make) : make_(std::move(make)) {}

  /// Returns an idle tile with its last contents, or a new tile. The tile returns to the pool when the handle ends.
  Handle take() {
    {
      const std::scoped_lock lock(guard_);
      if (!idle_.empty()) {
        Handle tile(idle_.back().release(), {this});
        idle_.pop_back();
        return tile;
      }
    }
    return Handle(make_().release(), {this});
  }

 private:
  void give_back(std::unique_ptr<Tile> tile) {
    const std::scoped_lock lock(guard_);
    idle_.push_back(std::move(tile));
  }

  std::function<std::unique_ptr<Tile>()> make_;
  std::mutex guard_;
  std::vector<std::unique_ptr<Tile>> idle_;
};

}  // namespace insonify
