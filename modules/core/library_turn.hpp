// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mutex>

namespace insonify {

/// The turn of a thread in a library that only one thread at a time may use; `Library` is its name. A thread that has
/// the turn may take it again. So may a child process that it starts, where no other thread could give it back.
template <typename Library>
class LibraryTurn {
 public:
  /// Waits until no other thread has the turn.
  LibraryTurn() { take(); }
  ~LibraryTurn() { give_back(); }
  LibraryTurn(const LibraryTurn&) = delete;
  LibraryTurn& operator=(const LibraryTurn&) = delete;

  /// Waits like the constructor, without an object: for a handler of fork().
  static void take() {
    if (taken_++ == 0) lock_.lock();
  }
  /// Gives back the turn of take().
  static void give_back() {
    if (--taken_ == 0) lock_.unlock();
  }

 private:
  static inline std::mutex lock_;
  static inline thread_local int taken_ = 0;  // a recursive mutex would not know its owner again in a child process
};

}  // namespace insonify
