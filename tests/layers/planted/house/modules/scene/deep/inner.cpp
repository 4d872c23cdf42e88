// SPDX-License-Identifier: BSD-3-Clause
#include "core/deep/hidden_internal.hpp"
