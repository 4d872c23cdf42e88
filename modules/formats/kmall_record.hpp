// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "formats/swath_record.hpp"

namespace insonify {

/// Reads a .kmall file (Kongsberg 410224, EM datagrams on *.kmall format, revisions E to I): swaths of MRZ, profiles
/// (SVP) and attitudes (SKM); datagrams of other kinds are counted. Lengths that a datagram states for its parts
/// are kept to, so that parts which later revisions made longer are read too. Depths are z_reRefPoint_m less
/// z_waterLevelReRefPoint_m, across and along y and x from the vessel's reference point, levels reflectivity1_dB, and
/// the deviations those that the detection estimates. Pitch and roll are those of the last attitude before a ping.
/// Throws Error(file) if the file cannot be read, Error(content) if it is no such file, is truncated or damaged, or has
/// no swath.
SwathRecord read_kmall(const std::string& path);

}  // namespace insonify
