#pragma once
#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace insonify::tool {

/// Thrown by a verb that ends by itself after Ctrl-C, keeping what is done.
struct Interrupted {
  std::string kept;
};

/// Thrown when some pings of a survey failed and all others are kept: exit code 5.
struct SomeFailed {
  std::string which;
};

/// The text with a blank for every control character: what a file holds cannot make two lines of a message, nor colour it.
inline std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
  return text;
}

/// Runs a program, reports on stderr what it throws, and returns the exit code (docs/troubleshooting.md). `less` says what
/// takes less memory.
inline int run_program(const std::function<int()>& run, const char* less) {
  constexpr int no_memory = 4, exit_codes[] = {1, 2, 3, 4, no_memory};  // of runtime, argument, content, file
  try {
    return run();
  } catch (const Interrupted& interrupted) {
    std::fprintf(stderr, "insonify: interrupted; %s\n", interrupted.kept.c_str());
    return 130;
  } catch (const SomeFailed& failed) {
    std::fprintf(stderr, "insonify: %s\n", failed.which.c_str());
    return 5;
  } catch (const Error& error) {
    std::fprintf(stderr, "insonify: %s\n", one_line(error.what()).c_str());
    return exit_codes[static_cast<int>(error.kind())];
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
    return no_memory;
  } catch (const std::length_error&) {  // an array beyond all memory
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
    return no_memory;
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "insonify: %s\n", one_line(error.what()).c_str());
    // A thread that cannot be started lacks memory.
    if (error.code() == std::errc::resource_unavailable_try_again) return no_memory;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "insonify: %s\n", one_line(error.what()).c_str());
  }
  return 1;
}

}  // namespace insonify::tool
