// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "tool/command/exit_code.hpp"

namespace insonify::tool {

/// Thrown by a verb that ends by itself after Ctrl-C, keeping what is done.
struct Interrupted {
  std::string kept;
};

/// Thrown when some pings of a survey failed and all others are kept.
struct SomeFailed {
  std::string which;
};

/// The text with a blank for every control character: what a file holds cannot make two lines of a message, nor colour
/// it.
inline std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
  return text;
}

/// Runs a program, reports on stderr what it throws, and returns the exit code. `less` says what
/// takes less memory.
inline int run_program(const std::function<int()>& run, const char* less) {
  constexpr ExitCode no_memory = exit_code_of(ErrorKind::memory);
  try {
    return run();
  } catch (const Interrupted& interrupted) {
    std::fprintf(stderr, "insonify: interrupted; %s\n", interrupted.kept.c_str());
    return exit_interrupted;
  } catch (const SomeFailed& failed) {
    std::fprintf(stderr, "insonify: %s\n", failed.which.c_str());
    return exit_some_failed;
  } catch (const Error& error) {
    std::fprintf(stderr, "insonify: %s\n", one_line(error.what()).c_str());
    return exit_code_of(error.kind());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
    return no_memory;
  } catch (const std::length_error&) {  // an array beyond all memory
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
    return no_memory;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "insonify: %s: %s; check the path\n", one_line(error.path1().string()).c_str(),
                 error.code().message().c_str());
    return exit_code_of(ErrorKind::file);
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "insonify: %s\n", one_line(error.what()).c_str());
    // A thread that cannot be started lacks memory.
    if (error.code() == std::errc::resource_unavailable_try_again) return no_memory;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "insonify: %s\n", one_line(error.what()).c_str());
  }
  return exit_failure;
}

}  // namespace insonify::tool
