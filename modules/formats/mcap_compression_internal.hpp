// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

#include "formats/mcap_file.hpp"

namespace insonify {

/// Returns the name of a compression in chunks; "" for none.
std::string_view mcap_compression_name(McapCompression compression);

/// Returns the bytes as one frame of the compression, unchanged for none. Throws Error(argument) for a compression that
/// this build lacks.
std::string compressed(McapCompression compression, std::string_view bytes);

}  // namespace insonify
