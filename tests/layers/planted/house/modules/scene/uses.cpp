// SPDX-License-Identifier: BSD-3-Clause
#include "core/hidden_internal.hpp"
