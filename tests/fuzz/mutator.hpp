// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "fuzz/readers.hpp"

namespace insonify {

/// Damages files at random; the same ones for the same seed.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// Returns a damaged seed, mostly with the reader's own damage, if it has one.
  std::string mutant(const FuzzedReader& reader, const std::vector<std::string>& seeds);

 private:
  std::size_t below(std::size_t end) {
    return end ? std::uniform_int_distribution<std::size_t>(0, end - 1)(random_) : 0;
  }
  void damage(std::string& bytes, const std::string& other);
  // Writes an integer that is a count too large, or negative, of 1 to 8 bytes in either order.
  void put_integer(std::string& bytes, std::size_t at);
  // Replaces the next number by another text.
  void replace_number(std::string& bytes, std::size_t at);

  std::mt19937_64 random_;
};

}  // namespace insonify
