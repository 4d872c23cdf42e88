// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <mutex>

namespace insonify {

/// An object that is made at its first use, by one of the threads that ask for it.
template <typename Thing>
class Lazy {
 public:
  /// Returns the object. The first call makes it: make() returns a std::unique_ptr to a new object.
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
