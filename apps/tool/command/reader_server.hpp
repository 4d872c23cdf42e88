// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <sys/types.h>

#include "files/read_apart.hpp"

namespace insonify::tool {

/// Returns as fork(): the only place where a program forks. The child ends with this process.
pid_t fork_child();

/// Reads files of strangers for this process during its lifetime (set_reader_process). It is a process that is forked
/// before this one has any thread, never has one itself, and forks for each file a reader: a damaged file ends that
/// reader, or meets its limits. Readers have limits of memory and time, and hand over arrays in shared memory. Files
/// are read one after the other, whichever thread asks.
class ReaderServer {
 public:
  /// Starts the process. If it cannot be started, reading files is Error(runtime).
  ReaderServer();
  /// Ends the process, and waits for its end.
  ~ReaderServer();
  ReaderServer(const ReaderServer&) = delete;
  ReaderServer& operator=(const ReaderServer&) = delete;

  /// Returns the process.
  pid_t process() const { return server_; }

 private:
  int socket_ = -1;
  pid_t server_ = -1;
  ReaderProcess before_;
};

}  // namespace insonify::tool
