// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// A limit of the accuracy of pings, with a remedy: gathered by kind from all pings that have it.
struct PingNote {
  std::string kind;        ///< a few words without tabs and line ends, e.g. "sparse beams"
  std::string text;        ///< one sentence, from the first ping
  std::size_t count = 1;   ///< number of pings with a note of this kind
  std::int64_t first = 0;  ///< number of the first ping
  bool operator==(const PingNote&) const = default;
};

/// Adds notes of other pings. Counts of a kind add up, and the text is that of the ping with the lowest number; kinds
/// are sorted by their first ping, then by name. The result does not depend on the order of the calls.
void gather(std::vector<PingNote>& into, const std::vector<PingNote>& more);

/// Returns the note as a sentence: its text, after "12 pings, the first 3: " or "1 ping, number 3: " unless `alone`,
/// for a run of one ping.
std::string sentence(const PingNote& note, bool alone = false);

/// Returns the notes as text, a line each: count, first ping, kind and text, with a tab between them.
std::string as_lines(const std::vector<PingNote>& notes);

/// Returns the notes that as_lines wrote; lines of another form are left out.
std::vector<PingNote> notes_in(std::string_view lines);

}  // namespace insonify
