// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <vector>

#include <boost/core/noinit_adaptor.hpp>

namespace insonify {

/// A vector whose new elements are not set, for large arrays that threads fill side by side: else one thread alone
/// would first write zeros to all of them, and wait for the memory, a page at a time.
template <typename T>
using UninitializedVector = std::vector<T, boost::noinit_adaptor<std::allocator<T>>>;

}  // namespace insonify
