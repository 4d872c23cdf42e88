// SPDX-License-Identifier: BSD-3-Clause
namespace insonify {
namespace {
struct Hidden {};
}  // namespace

struct Hidden {};
enum class TimeAxis { range, delay };

int second() { return 2; }
int third() {
  int sum = 0;
  sum += second();
  return sum;
}
}  // namespace insonify
