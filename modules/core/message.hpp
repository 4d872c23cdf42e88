// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"

namespace insonify {

/// Number of entries that a list in a message shows.
inline constexpr std::size_t most_listed = 10;

/// Returns a text of unknown length for a message: of more than 200 bytes the middle is replaced by " ... ". A UTF-8
/// character is never split.
std::string shortened(std::string_view text);

/// Returns a message as one line. A blank replaces each control character. Words and quoted texts of more than 260
/// bytes that cannot be paths are shortened. If more than 2000 bytes remain beside paths, words in the middle are left
/// out. A path has at most 4096 bytes, 255 of them between slashes.
std::string message_line(std::string_view message);

/// Returns the first ten entries of a list, each shortened, with `separator` between them, and how many more there are:
/// "a, b and 3 more".
template <typename List, typename TextOf = std::identity>
std::string shortened_list(const List& list, const char* separator = ", ", TextOf text_of = {}) {
  std::vector<std::string> shown;
  for (const auto& entry : list) {
    if (shown.size() == most_listed) break;
    shown.push_back(shortened(std::invoke(text_of, entry)));
  }
  const std::size_t more = std::size(list) - shown.size();
  return joined(shown, separator) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

}  // namespace insonify
