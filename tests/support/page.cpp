// SPDX-License-Identifier: BSD-3-Clause
#include "support/page.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "support/files.hpp"

namespace insonify {

void expect_reference_page(const std::string& name, const std::string& text) {
  const std::string path = std::string(INSONIFY_REFERENCE_PAGES) + "/" + name;
  const std::string page =
      "<!-- Written by docs/make_reference.sh from a table of the product; do not edit. -->\n" + text;
  if (std::getenv("INSONIFY_WRITE_PAGES")) std::ofstream(path, std::ios::binary) << page;
  const std::string found = file_exists(path) ? file_bytes(path) : "";
  std::istringstream rows(page);
  for (std::string row; std::getline(rows, row);)
    if (found.find(row + "\n") == found.npos) ADD_FAILURE() << path << " lacks this row:\n" << row;
  EXPECT_TRUE(found == page) << path << " differs from the product's table; run docs/make_reference.sh";
}

std::string table_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text.empty() ? " |" : " " + text + " |";
}

}  // namespace insonify
