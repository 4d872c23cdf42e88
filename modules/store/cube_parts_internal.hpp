// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "hdf/hdf5_internal.hpp"
#include "store/cube_arrays_internal.hpp"

// Private to store: the parts of a scene in cubes of pings with labels.
namespace insonify {

/// Throws Error(argument) if the parts of a ping are not those of the first ping of the cube at `path`.
void require_same_parts(const Ping& ping, const Ping& first, const std::string& path);

/// Writes names, labels and views of the parts, if the first ping has parts.
void write_parts(const hdf5::FileContext& context, hid_t file, const std::vector<Ping>& pings);

/// Returns true if a cube has parts.
bool has_parts(hid_t file);

/// Sends names, labels and views of the parts for some pings of a cube that has them, and receives them.
void send_parts(const hdf5::FileContext& context, hid_t file, const hdf5::Extent& extent, PingRange pings,
                ArraySender& to);
void receive_parts(ArrayReceiver& sent, std::vector<Ping>& pings);

}  // namespace insonify
