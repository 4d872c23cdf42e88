// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "files/child_arrays.hpp"

namespace insonify {

/// Limits of a child process.
struct ChildLimits {
  std::size_t memory = std::size_t{1} << 30;  ///< address space beyond that of this process [bytes]
  unsigned seconds = 60;                      ///< processor time; the limit of wall time is five times this [s]
  std::size_t sent = std::size_t{1} << 38;    ///< largest result, if the user's limits leave twice that [bytes]
};

/// Returns the limits for a library that reads a file of `bytes` bytes.
ChildLimits limits_of_file(std::size_t bytes);

/// Runs `read` in a forked child within the limits, and returns the values that it sent. Libraries that are not ours
/// read foreign files in a child, because damaged files can make them crash or take unlimited memory. The child's
/// memory ends with the child, except the values that it sent. Throws the Error that `read` threw, with its kind and
/// text; Error(content), which begins with `path`, if a signal or the limits end the child; std::bad_alloc if a limit
/// of this process leaves the child less memory than its own limit. `read` must use no thread that this process has
/// started, and no lock that such a thread may hold.
ArrayReceiver read_in_child(const std::string& path, const ChildLimits& limits,
                            const std::function<void(ArraySender&)>& read);

/// Runs a `read` that sends no values in the same way.
void try_in_child(const std::string& path, const ChildLimits& limits, const std::function<void()>& read);

/// A number of values that a file announces.
struct Announced {
  double count;
  const char* what;  ///< pixels, cells, samples
  double bytes;      ///< that each takes in memory
  const char* remedy = "copy or export it again";
};

/// Throws Error(content) if a file of `bytes` announces more than 64 MiB and 1032 times its size, the largest factor of
/// zlib: the file is damaged, or made to exhaust memory. In a child of read_in_child, the limits of the child grow by
/// the announced memory, and by a second for every 10 MiB of it.
void expect_from_file(const std::string& path, std::size_t bytes, const Announced& announced);

}  // namespace insonify
