// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sanitizers are initialised after the loader resolves function variants and crash on them, so they use the plain code.
// Clang uses it too, because it has no variants of function templates.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
#define INSONIFY_CLONES
#else
#define INSONIFY_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
