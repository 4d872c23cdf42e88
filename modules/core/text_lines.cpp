// SPDX-License-Identifier: BSD-3-Clause
#include "core/text_lines.hpp"

#include <cctype>

namespace insonify {

std::string shown(std::string_view line) {
  std::string text(line.substr(0, 60));
  for (char& c : text) {
    if (!std::isprint(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128) c = '?';
  }
  return text + (line.size() > 60 ? "..." : "");
}

}  // namespace insonify
