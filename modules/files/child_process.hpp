// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "files/child_arrays.hpp"

namespace insonify {

/// What a child process may use.
struct ChildLimits {
  std::size_t memory = std::size_t{1} << 30;  ///< address space beyond that of this process [bytes]
  unsigned seconds = 60;                      ///< of processor; of the clock five times that
  std::size_t sent = std::size_t{1} << 38;    ///< that it may hand over, if the user's limits leave twice that [bytes]
};

/// What a library may use to read a file of so many bytes.
ChildLimits limits_of_file(std::size_t bytes);

/// Runs `read` in a forked child within the limits, and returns what it sent: libraries that are not ours read the
/// files of others there, since they crash, or take memory without end, on damaged ones. The child's memory is lost
/// with it, but for what it sent. Throws the Error that `read` threw, with its kind and text; Error(content), which
/// begins with `path`, if the child is ended by a signal or the limits; std::bad_alloc if a limit of this process
/// leaves the child less memory than its own. `read` must use no thread that this process has started, and no lock that
/// one of them may hold.
ArrayReceiver read_in_child(const std::string& path, const ChildLimits& limits,
                            const std::function<void(ArraySender&)>& read);

/// The same for what hands nothing over.
void try_in_child(const std::string& path, const ChildLimits& limits, const std::function<void()>& read);

/// A number of values that a file announces.
struct Announced {
  double count;
  const char* what;  ///< pixels, cells, samples
  double bytes;      ///< that each takes in memory
  const char* remedy = "copy or export it again";
};

/// Throws Error(content) if a file of `bytes` announces more than 64 MiB and 1032 times its size, which is what zlib
/// packs at most: it is damaged, or made to take memory. In a child of read_in_child, which may then use as much more
/// memory, and a second for every 10 MiB of it.
void expect_from_file(const std::string& path, std::size_t bytes, const Announced& announced);

}  // namespace insonify
