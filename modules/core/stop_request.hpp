// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>

namespace insonify {

/// Exception of parallel loops that are asked to stop. It is no Error, and no function of the library catches it.
struct Stopped {};

/// While an object of this class lives, parallel loops that its thread begins throw Stopped soon after `stop` is true:
/// when they begin, and after each call that this thread makes. Loops that other threads begin go on.
class StopScope {
 public:
  /// `stop` must outlive this object.
  explicit StopScope(const std::atomic<bool>& stop);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const std::atomic<bool>* outer_;
};

}  // namespace insonify
