// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "acoustics/echoes.hpp"
#include "core/parallel.hpp"

namespace insonify {

inline void add_echo(Echoes& echoes, double delay, double u, double v, std::complex<double> amplitude) {
  echoes.delay.push_back(delay);
  echoes.u.push_back(u);
  echoes.v.push_back(v);
  echoes.amplitude.push_back(amplitude);
}

/// Adds the echoes of all parts, in order; frees the parts on the way.
inline void join_echoes(std::vector<Echoes>&& shares, Echoes& all) {
  if (shares.size() == 1 && all.size() == 0) {
    all = std::move(shares[0]);
    return;
  }
  std::size_t total = all.size();
  for (const Echoes& share : shares) total += share.size();
  const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  all.delay.reserve(total);
  all.u.reserve(total);
  all.v.reserve(total);
  all.amplitude.reserve(total);
  for (Echoes& share : shares) {
    append(all.delay, share.delay);
    append(all.u, share.u);
    append(all.v, share.v);
    append(all.amplitude, share.amplitude);
    append(all.doppler, share.doppler);
    share = {};
  }
}

/// Calls body(begin, end, echoes) for blocks that tile [0, n), each with echoes of its own to add to; joined in order,
/// so that the result does not depend on `threads`.
template <typename Body>
Echoes collect_echoes(std::size_t n, std::size_t block, int threads, Body&& body) {
  std::vector<Echoes> shares((n + block - 1) / block);
  parallel_blocks(n, block, threads,
                  [&](std::size_t begin, std::size_t end) { body(begin, end, shares[begin / block]); });
  Echoes all;
  join_echoes(std::move(shares), all);
  return all;
}

/// Returns the amplitude xi of a patch: bound to its id and the seed, the same on every path to the patch.
std::complex<double> surface_amplitude(const EchoOptions& options, double coherent_fraction, std::uint64_t id);

}  // namespace insonify
