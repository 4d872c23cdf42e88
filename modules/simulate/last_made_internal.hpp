// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace insonify {

/// The objects that were last asked for, by key. The first who asks makes the object, outside of the lock: threads that
/// ask for other keys do not wait for it. May be used by several threads at once.
template <typename Key, typename Made>
class LastMade {
 public:
  explicit LastMade(std::size_t most) : most_(most) {}

  /// Returns the object of `key`: make(), if it is not kept. What make() throws, of() throws, and the next call tries
  /// again.
  template <typename Make>
  std::shared_ptr<const Made> of(const Key& key, const Make& make) {
    const std::shared_ptr<Row> row = row_of(key);
    const std::scoped_lock lock(row->guard);
    if (!row->made) row->made.emplace(make());
    return {row, &*row->made};
  }

 private:
  struct Row {
    Key key;
    std::mutex guard{};
    std::optional<Made> made{};
    explicit Row(Key of) : key(std::move(of)) {}
  };

  std::shared_ptr<Row> row_of(const Key& key) {
    const std::scoped_lock lock(guard_);
    const auto at = std::find_if(rows_.begin(), rows_.end(), [&](const auto& row) { return row->key == key; });
    if (at != rows_.end()) {
      std::rotate(rows_.begin(), at, at + 1);
    } else {
      rows_.insert(rows_.begin(), std::make_shared<Row>(key));
      if (rows_.size() > most_) rows_.pop_back();
    }
    return rows_.front();
  }

  std::size_t most_;
  std::mutex guard_;
  std::vector<std::shared_ptr<Row>> rows_;  ///< the last used first
};

}  // namespace insonify
