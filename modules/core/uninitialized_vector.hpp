// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <vector>

#include <boost/core/noinit_adaptor.hpp>

namespace insonify {

/// A vector whose new elements are not set, for large arrays that several threads fill. A plain vector would first
/// write zeros to all elements on one thread.
template <typename T>
using UninitializedVector = std::vector<T, boost::noinit_adaptor<std::allocator<T>>>;

}  // namespace insonify
