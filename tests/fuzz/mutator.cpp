// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mutator.hpp"

#include <algorithm>
#include <iterator>

namespace insonify {

std::string Mutator::mutant(const FuzzedReader& reader, const std::vector<std::string>& seeds) {
  std::string bytes = seeds[below(seeds.size())];
  if (reader.damage && below(8) > 0)
    return reader.damage(bytes, {[this](std::size_t end) { return below(end); },
                                 [this](std::string part) {
                                   damage(part, part);
                                   return part;
                                 }});
  for (std::size_t left = 1 + below(4); left > 0; --left) damage(bytes, seeds[below(seeds.size())]);
  return bytes;
}

void Mutator::damage(std::string& bytes, const std::string& other) {
  if (bytes.empty()) bytes = "0";
  const std::size_t at = below(bytes.size()), length = 1 + below(std::min<std::size_t>(64, bytes.size() - at));
  switch (below(10)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(below(256));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 4:
      bytes.resize(at);
      break;
    case 5:
      bytes.insert(at, other.substr(below(other.size()), length));
      break;
    case 6:
      put_integer(bytes, at);
      break;
    case 7:
      bytes = bytes.substr(0, at) + other.substr(std::min(at, other.size()));
      break;
    default:
      replace_number(bytes, at);
  }
}

void Mutator::put_integer(std::string& bytes, std::size_t at) {
  static constexpr std::uint64_t values[] = {0,
                                             1,
                                             0x7f,
                                             0xff,
                                             0x7fff,
                                             0xffff,
                                             0x7fffffff,
                                             0xffffffff,
                                             1u << 30,
                                             0x7fffffffffffffff,
                                             0xffffffffffffffff,
                                             1ull << 40};
  const std::uint64_t value = values[below(std::size(values))];
  const std::size_t size = std::min(std::size_t{1} << below(4), bytes.size() - at);
  const bool swapped = below(2) == 1;
  for (std::size_t i = 0; i < size; ++i) bytes[at + (swapped ? size - 1 - i : i)] = static_cast<char>(value >> 8 * i);
}

void Mutator::replace_number(std::string& bytes, std::size_t at) {
  static const char* const texts[] = {"0",
                                      "-1",
                                      "1",
                                      "nan",
                                      "inf",
                                      "1e308",
                                      "-1e308",
                                      "2147483647",
                                      "4294967295",
                                      "4294967296",
                                      "9223372036854775807",
                                      "18446744073709551615",
                                      "1e-320",
                                      "x",
                                      "",
                                      "999999999",
                                      "0.1.2",
                                      "3",
                                      "100000"};
  const char* digits = "0123456789";
  const std::size_t begin = bytes.find_first_of(digits, at);
  if (begin == bytes.npos) return;
  const std::size_t end = std::min(bytes.find_first_not_of("0123456789.eE+-", begin), bytes.size());
  bytes.replace(begin, end - begin, texts[below(std::size(texts))]);
}

}  // namespace insonify
