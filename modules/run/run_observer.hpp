// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Hears what the making of a run says: its steps, and notes for the user. By itself it says nothing.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// The next step begins.
  virtual void step(const std::string&) {}
  /// A sentence: a limit, an assumption, something left out.
  virtual void note(const std::string&) {}
};

}  // namespace insonify
