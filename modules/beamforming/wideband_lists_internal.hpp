#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "beamforming/wideband_block_internal.hpp"

namespace insonify {

/// Which echoes belong to which block, in order of parts of a block and, within one, of number.
class WidebandLists {
 public:
  WidebandLists(const SeenEchoes& seen, const WidebandPlan& plan, std::size_t array_part);

  bool empty(std::size_t block) const { return begin_[block * parts] == begin_[(block + 1) * parts]; }
  /// The echoes of a block; cut by range, if their wavefronts differ too much, as often as it takes.
  std::vector<WidebandBlock> of(std::size_t block) const;

 private:
  static constexpr std::size_t parts = 16;  ///< of a block

  std::span<const std::uint32_t> list(std::size_t first_part, std::size_t last_part) const {
    return {echo_.data() + begin_[first_part], begin_[last_part] - begin_[first_part]};
  }
  WidebandBlock block_of(std::size_t number, std::span<const std::uint32_t> list) const;

  const SeenEchoes& seen_;
  const WidebandPlan& plan_;
  std::size_t array_part_;
  std::vector<std::uint32_t> begin_, echo_;
};

}  // namespace insonify
