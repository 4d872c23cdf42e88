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

namespace insonify::tool {

/// How a program ends.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,
  exit_usage = 2,
  exit_content = 3,
  exit_file = 4,
  exit_some_failed = 5,
  exit_interrupted = 130,
  exit_no_reader = 141  ///< code that a shell reports for SIGPIPE
};

/// An exit code with its meaning in man pages and docs/troubleshooting.md.
struct ExitCodeText {
  ExitCode code;
  const char* meaning;
};
inline constexpr ExitCodeText exit_code_texts[] = {
    {exit_ok, "ok"},
    {exit_failure, "run-time failure"},
    {exit_usage, "wrong usage"},
    {exit_content, "unusable content"},
    {exit_file, "file missing or not writable, or too little memory"},
    {exit_some_failed, "some pings of a survey failed and all others are kept"},
    {exit_interrupted, "interrupted"},
    {exit_no_reader, "the reader of the output has gone"}};

/// The exit code of an error.
constexpr ExitCode exit_code_of(ErrorKind kind) {
  constexpr ExitCode codes[] = {exit_failure, exit_usage, exit_content, exit_file, exit_file};  // in the order of kinds
  return codes[static_cast<int>(kind)];
}

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

/// Returns the exit code of `run`, during which a ReaderServer reads files of strangers. Under a limit of address space
/// (ulimit -v) a child process runs it: libraries that end their process where they get no memory are reported as exit
/// code 4 in one line, which `less` completes. Signals that are sent to this process reach the child.
int under_memory_guard(const std::function<int()>& run, const char* less);

/// The program: parses the command line and runs its verb; errors go to stderr. Returns the exit code.
int run_tool(int argc, char** argv);

}  // namespace insonify::tool
