#pragma once

// Sanitizers start after the loader has chosen a variant, and crash on it: they get the plain one.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define INSONIFY_CLONES
#else
#define INSONIFY_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
