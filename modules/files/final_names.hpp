// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Returns a message with the final names of outputs in place of the temporary ones of PendingPath, which are gone when
/// the message is read.
std::string with_final_names(std::string message);

}  // namespace insonify
