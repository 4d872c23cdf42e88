// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

namespace insonify::tool {

/// Returns the exit code of `run`, during which a ReaderServer reads files of strangers. Under a limit of address space
/// (ulimit -v) a child process runs it: libraries that end their process where they get no memory are reported as exit
/// code 4 in one line, which `less` completes. Signals that are sent to this process reach the child.
int under_memory_guard(const std::function<int()>& run, const char* less);

}  // namespace insonify::tool
