#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes docs/reference: the keys of TOML files, the fields of GSF, the columns of exports and the objects, from the tables of the product. The same tests
# without INSONIFY_WRITE_PAGES fail where a page differs from its table.
#   docs/make_reference.sh [build/dev/bin]
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${1:-build/dev/bin}
export INSONIFY_WRITE_PAGES=1
"$bin/store_test" --gtest_brief=1 --gtest_filter=KeyTables.are_those_of_the_page_of_keys
"$bin/formats_test" --gtest_brief=1 --gtest_filter=GsfFile.fields_are_those_of_the_page_of_fields
"$bin/tool_test" --gtest_brief=1 --gtest_filter=MakeObject.is_documented_as_its_table_says:SoundingMap.and_other_exports_have_the_columns_of_the_page
