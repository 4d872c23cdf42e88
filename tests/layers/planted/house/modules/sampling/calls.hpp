// SPDX-License-Identifier: BSD-3-Clause
namespace insonify {
struct Calls {
  std::function<void()> call;
};
}  // namespace insonify
