// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <vector>

#include "files/child_process.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: clouds that a library reads in a child process.
namespace insonify {

/// What the child hands over of its rows; their bytes were taken of the sender first, by take_array<char>.
struct SentRows {
  std::vector<RowTable::Column> columns;
  std::size_t rows = 0, stride = 0;
};

/// Columns of doubles, one per name, and so many rows of them.
SentRows rows_of_doubles(const std::vector<std::string>& names, std::size_t rows);

/// Reads a file of `bytes`, with what it refers to: read(to, raw) runs in a child process, in which it takes room for
/// the rows from `to`, fills it, and sets members of its copy of `raw`. They become those of `raw`, and the rows its
/// points, by fill_cloud. Throws as read_in_child and fill_cloud do.
void read_rows_apart(RawCloud& raw, std::size_t bytes, const ReadOptions& options,
                     const std::function<SentRows(ArraySender& to, RawCloud& raw)>& read);

}  // namespace insonify
