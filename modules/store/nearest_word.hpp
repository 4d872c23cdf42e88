// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Returns a suggestion for a misspelt word: the entry of `known` nearest to `word` by edit distance, or "" if none is
/// within a third of its length (at least 2).
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// Returns the suggestion for the end of a message: "; did you mean 'range'?" or "".
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace insonify
