#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace insonify {

/// What a child process may use.
struct ChildLimits {
  std::size_t memory = std::size_t{1} << 30;  ///< address space beyond that of this process [bytes]
  unsigned seconds = 60;                      ///< of processor, and of the clock
};

/// Runs `read` in a forked child within the limits, for libraries that crash, or take memory without end, on damaged
/// files: its memory is lost with it, and what it throws as an Error counts as an end in order, since the caller will meet
/// it again. Throws Error(content), which begins with `path`, if the child is ended by a signal, the limits or a lack of
/// memory. `read` must use no thread that this process has started, and no lock that one of them may hold.
void try_in_child(const std::string& path, const ChildLimits& limits, const std::function<void()>& read);

/// The same for what must not be read in this process at all: returns what `read` returned in the child, empty if it threw
/// an Error.
std::string read_in_child(const std::string& path, const ChildLimits& limits, const std::function<std::string()>& read);

}  // namespace insonify
