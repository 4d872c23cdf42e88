#pragma once
#include <cstdio>
#include <exception>
#include <functional>
#include <new>

#include "core/error.hpp"

namespace insonify::tool {

/// Thrown at the next step after Ctrl-C.
struct Interrupted {};

/// Runs a program, reports on stderr what it throws, and returns the exit code (docs/troubles.md). `less` says what
/// takes less memory.
inline int run_program(const std::function<int()>& run, const char* less) {
  constexpr int exit_codes[] = {1, 2, 3, 4};  // of runtime, argument, content, file
  try {
    return run();
  } catch (const Interrupted&) {
    std::fputs("insonify: interrupted; nothing was written\n", stderr);
    return 130;
  } catch (const Error& error) {
    std::fprintf(stderr, "insonify: %s\n", error.what());
    return exit_codes[static_cast<int>(error.kind())];
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "insonify: %s\n", error.what());
  }
  return 1;
}

}  // namespace insonify::tool
