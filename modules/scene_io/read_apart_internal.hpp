// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <vector>

#include "files/child_process.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: clouds that a library reads in a child process.
namespace insonify {

template <typename Stream, typename Value>
void pass(Stream& stream, Meant<Value>& fact) {
  stream(fact.value, fact.origin, fact.sentence);
}

template <typename Stream>
void pass(Stream& stream, FileMeaning& m) {
  stream(m.unit, m.unit_z, m.z_down, m.y_up, m.band, m.no_data, m.valid, m.classes, m.system, m.no_lengths);
}

/// The layout of the rows that a child sends. The bytes came from the sender before, by take_array<char>.
struct SentRows {
  std::vector<RowTable::Column> columns;
  std::size_t rows = 0, stride = 0;
};

/// Returns the layout of `rows` rows of doubles with one column per name.
SentRows rows_of_doubles(const std::vector<std::string>& names, std::size_t rows);

/// Reads a file and the files that it refers to, `bytes` in all, in a child process. There read(to, raw) takes memory
/// for the rows from `to`, fills it, and sets members of its copy of `raw`. These members become those of `raw`, and
/// fill_cloud makes its points from the rows. Throws as read_in_child and fill_cloud.
void read_rows_apart(RawCloud& raw, std::size_t bytes, const ReadOptions& options,
                     const std::function<SentRows(ArraySender& to, RawCloud& raw)>& read);

}  // namespace insonify
