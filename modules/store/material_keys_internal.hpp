// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "store/key_table_internal.hpp"
#include "store/materials_file.hpp"

namespace insonify {

/// A [[material]] of a file.
struct MaterialEntry {
  SourcedMaterial sourced;
  MaterialInterval interval{};  ///< of field values, if the file has one
};

/// The keys of a [[material]], bound to it: those of material_numbers among them.
std::vector<Key> material_keys(MaterialEntry& entry);

}  // namespace insonify
