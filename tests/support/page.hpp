// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Fails unless the page docs/reference/NAME has exactly `text`, which is made of a table of the product, below a line
/// that says so. With INSONIFY_WRITE_PAGES in the environment, as docs/make_reference.sh sets it, writes the page.
void expect_reference_page(const std::string& name, const std::string& text);

/// Returns a cell of a table in Markdown, with the blank before it and the bar behind it.
std::string table_cell(std::string text);

}  // namespace insonify
