// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_part.hpp"

#include "core/random.hpp"

namespace insonify {

std::uint64_t part_key(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return random_bits(hash, RandomStage::scene_points, {name.size(), 0, 1})[0];
}

}  // namespace insonify
