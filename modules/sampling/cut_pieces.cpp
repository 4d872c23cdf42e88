// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <bit>
#include <span>

#include "core/parallel.hpp"
#include "core/radix_sort.hpp"
#include "sampling/cut_pieces_internal.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {
namespace {

// About half of the surfels of a relief that turns away face away from the head, and half of this part of the energy of a
// tenth of the ranges is 0.1 dB (E225).
constexpr double much_turned = 0.0455;

/// The ranks of marked surfels: their indices in a cut.
class Ranks {
 public:
  Ranks(const std::vector<CutPiece>& pieces, std::size_t surfels, int threads) {
    marks_.words.resize((surfels + 63) / 64);
    parallel_for(pieces.size(), threads, [&](std::size_t p) {
      for (const std::uint32_t i : pieces[p].stands_for)
        std::atomic_ref(marks_.words[i / 64]).fetch_or(std::uint64_t{1} << i % 64, std::memory_order_relaxed);
    });
    before_.reserve(marks_.words.size());
    for (const std::uint64_t word : marks_.words) {
      before_.push_back(all_);
      all_ += static_cast<std::uint32_t>(std::popcount(word));
    }
  }
  std::size_t all() const { return all_; }
  std::uint32_t of(std::uint32_t surfel) const {
    const std::uint64_t below = marks_.words[surfel / 64] & ((std::uint64_t{1} << surfel % 64) - 1);
    return before_[surfel / 64] + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  SurfelMarks marks_;
  std::vector<std::uint32_t> before_;  // each word
  std::uint32_t all_ = 0;
};

/// First numbers of the surfels of each part, and the number of all.
std::vector<std::size_t> firsts_of(const std::vector<CutPiece>& pieces) {
  std::vector<std::size_t> first{0};
  for (const CutPiece& piece : pieces) first.push_back(first.back() + piece.stands_for.size());
  return first;
}

/// Moves the surfels of a part to their positions in the cut.
template <typename... Arrays>
void scatter(const SceneCloud& from, std::span<const std::uint32_t> positions, SceneCloud& to, Arrays... arrays) {
  const auto move = [&](auto array) {
    for (std::size_t k = 0; k < (from.*array).size(); ++k) (to.*array)[positions[k]] = (from.*array)[k];
  };
  (move(arrays), ...);
}

/// The parts as one scene with all but the surfels of `like`. `positions`: in it, of the surfels of all parts.
SceneCloud joined(const std::vector<CutPiece>& pieces, const std::vector<std::uint32_t>& positions,
                  const SceneCloud& like, bool noisy, int threads) {
  SceneCloud cut;
  const auto resize = [&](auto... arrays) { ((cut.*arrays).resize(positions.size()), ...); };
  resize(&SceneCloud::point, &SceneCloud::normal, &SceneCloud::area, &SceneCloud::material, &SceneCloud::id,
         &SceneCloud::unevenness);
  if (noisy) resize(&SceneCloud::noise);
  const std::vector<std::size_t> first = firsts_of(pieces);
  parallel_for(pieces.size(), threads, [&](std::size_t p) {
    scatter(pieces[p].scene, std::span(positions).subspan(first[p], first[p + 1] - first[p]), cut, &SceneCloud::point,
            &SceneCloud::normal, &SceneCloud::area, &SceneCloud::material, &SceneCloud::id, &SceneCloud::unevenness,
            &SceneCloud::noise);
  });
  cut.origin = like.origin;
  cut.materials = like.materials;
  cut.normals_oriented = like.normals_oriented;
  return cut;
}

}  // namespace

void CutEnergy::add(const CutEnergy& other) {
  for (std::size_t t = 0; t < all.size(); ++t) all[t] += other.all[t], turned[t] += other.turned[t];
}

RangeTenths<bool> CutEnergy::hidden_by_relief() const {
  RangeTenths<bool> hidden{};
  for (std::size_t t = 0; t < all.size(); ++t)
    if (turned[t] > much_turned * all[t])
      for (std::size_t beside = t - (t > 0); beside <= std::min(t + 1, all.size() - 1); ++beside) hidden[beside] = true;
  return hidden;
}

CutEnergy energy_of(const std::vector<CutPiece>& pieces) {
  CutEnergy sum;
  for (const CutPiece& piece : pieces) sum.add(piece.energy);
  return sum;
}

OrderedCut::OrderedCut(const std::vector<CutPiece>& pieces, const SceneCloud& scene, int threads) {
  const Ranks ranks(pieces, scene.size(), threads);
  order.resize(ranks.all()), stands_for.resize(ranks.all());
  const std::vector<std::size_t> first = firsts_of(pieces);
  parallel_for(pieces.size(), threads, [&](std::size_t p) {
    for (std::size_t k = 0; k < pieces[p].stands_for.size(); ++k) {
      const std::uint32_t surfel = pieces[p].stands_for[k];
      order[first[p] + k] = ranks.of(surfel);
      stands_for[order[first[p] + k]] = surfel;
    }
  });
  cut = joined(pieces, order, scene, !scene.noise.empty(), threads);
}

SceneCloud joined_by_id(const std::vector<CutPiece>& pieces, const SceneCloud& like, bool noisy, int threads) {
  std::vector<std::uint64_t> by_id;  // id, number in the order of the parts
  for (const CutPiece& piece : pieces)
    for (const std::uint32_t id : piece.stands_for) by_id.push_back(std::uint64_t{id} << 32 | by_id.size());
  radix_sort(by_id, 32, 64, [](std::uint64_t k) { return k; });
  std::vector<std::uint32_t> order(by_id.size());
  for (std::size_t k = 0; k < by_id.size(); ++k)
    order[static_cast<std::uint32_t>(by_id[k])] = static_cast<std::uint32_t>(k);
  return joined(pieces, order, like, noisy, threads);
}

}  // namespace insonify
