// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Of a number that no noun names.
extern int number;  ///< of something
