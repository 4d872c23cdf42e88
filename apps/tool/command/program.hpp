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
#include "core/message.hpp"
#include "files/final_names.hpp"
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

/// Prints a message on stderr as message_line.
inline void print_error(const std::string& message) {
  std::fprintf(stderr, "insonify: %s\n", message_line(message).c_str());
}

/// Runs a program, reports on stderr what it throws, and returns the exit code. `less` says what
/// takes less memory.
inline int run_program(const std::function<int()>& run, const char* less) {
  constexpr ExitCode no_memory = exit_code_of(ErrorKind::memory);
  try {
    return run();
  } catch (const Interrupted& interrupted) {
    print_error("interrupted; " + interrupted.kept);
    return exit_interrupted;
  } catch (const SomeFailed& failed) {
    print_error(failed.which);
    return exit_some_failed;
  } catch (const Error& error) {
    print_error(with_final_names(error.what()));
    return exit_code_of(error.kind());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
    return no_memory;
  } catch (const std::length_error&) {  // an array beyond all memory
    std::fprintf(stderr, "insonify: out of memory; %s\n", less);
    return no_memory;
  } catch (const std::filesystem::filesystem_error& error) {
    print_error(error.path1().string() + ": " + error.code().message() + "; check the path");
    return exit_code_of(ErrorKind::file);
  } catch (const std::system_error& error) {
    print_error(error.what());
    // A thread that cannot be started lacks memory.
    if (error.code() == std::errc::resource_unavailable_try_again) return no_memory;
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return exit_failure;
}

}  // namespace insonify::tool
