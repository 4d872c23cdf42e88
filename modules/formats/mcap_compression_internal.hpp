// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

#include "formats/mcap_file.hpp"

namespace insonify {

/// As chunks name it; "" for none.
std::string_view mcap_compression_name(McapCompression compression);

/// Bytes as one frame of the compression; they themselves for none. Throws Error(argument) for one that this build
/// lacks.
std::string compressed(McapCompression compression, std::string_view bytes);

}  // namespace insonify
