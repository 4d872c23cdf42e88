// SPDX-License-Identifier: BSD-3-Clause
#include "core/hidden_internal.hpp"
bool is_there() { return std::filesystem::exists("a"); }
