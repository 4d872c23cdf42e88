// SPDX-License-Identifier: BSD-3-Clause
#include "returns/ping_note.hpp"

#include <algorithm>
#include <charconv>
#include <tuple>

namespace insonify {
namespace {

/// Removes the text before the next tab, or all of it, from `line` and returns it.
std::string_view take_cell(std::string_view& line) {
  const std::size_t tab = std::min(line.find('\t'), line.size());
  const std::string_view cell = line.substr(0, tab);
  line.remove_prefix(std::min(line.size(), tab + 1));
  return cell;
}

template <typename Number>
bool is_number(std::string_view cell, Number& number) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size();
}

}  // namespace

void gather(std::vector<PingNote>& into, const std::vector<PingNote>& more) {
  for (const PingNote& note : more) {
    const auto same = std::find_if(into.begin(), into.end(), [&](const PingNote& n) { return n.kind == note.kind; });
    if (same == into.end()) {
      into.push_back(note);
      continue;
    }
    same->count += note.count;
    if (std::tie(note.first, note.text) < std::tie(same->first, same->text))
      same->first = note.first, same->text = note.text;
  }
  std::sort(into.begin(), into.end(),
            [](const PingNote& a, const PingNote& b) { return std::tie(a.first, a.kind) < std::tie(b.first, b.kind); });
}

std::string sentence(const PingNote& note, bool alone) {
  if (alone) return note.text;
  return std::to_string(note.count) + (note.count == 1 ? " ping, number " : " pings, the first ") +
         std::to_string(note.first) + ": " + note.text;
}

std::string as_lines(const std::vector<PingNote>& notes) {
  std::string lines;
  for (const PingNote& n : notes) {
    std::string text = n.text;  // names in it may contain anything
    std::replace(text.begin(), text.end(), '\n', ' ');
    lines += std::to_string(n.count) + '\t' + std::to_string(n.first) + '\t' + n.kind + '\t' + text + '\n';
  }
  return lines;
}

std::vector<PingNote> notes_in(std::string_view lines) {
  std::vector<PingNote> notes;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    std::string_view line = lines.substr(0, end);
    lines.remove_prefix(std::min(lines.size(), end + 1));
    PingNote note;
    const std::string_view count = take_cell(line), first = take_cell(line);
    note.kind = take_cell(line), note.text = line;
    const bool numbered = is_number(count, note.count) && is_number(first, note.first);
    if (numbered && !note.text.empty()) notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace insonify
