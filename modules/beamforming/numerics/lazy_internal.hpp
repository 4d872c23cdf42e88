// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <mutex>

namespace insonify {

/// A thing that is made when it is first used, by one of the threads that ask for it.
template <typename Thing>
class Lazy {
 public:
  /// Returns the thing; make() returns a std::unique_ptr to a new one.
  template <typename Make>
  const Thing& get(const Make& make) const {
    std::call_once(made_, [&] { thing_ = make(); });
    return *thing_;
  }

 private:
  mutable std::once_flag made_;
  mutable std::unique_ptr<Thing> thing_;
};

}  // namespace insonify
