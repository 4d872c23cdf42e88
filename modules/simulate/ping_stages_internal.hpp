// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <vector>

#include "acoustics/double_echoes.hpp"
#include "acoustics/echo_stream.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "sampling/visible_surfels.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulated_ping.hpp"

/// The stages of a ping that are more than one call.
namespace insonify {

class LayerSum;
class SynthesizerTable;

/// Patches of surface and their direct echoes. They are stored if a later stage asks for all of them, and for an image
/// that has few. Otherwise they are counted, and made where they are used.
struct PingParts {
  bool stored = false;
  VisibleSurfels visible{};  ///< if sampled by surfels
  Sampling sampling{};       ///< the report; patches if stored
  Echoes direct{};           ///< if stored
  Multipath multipath{};
  Multipath mirrors{};  ///< without glints, which belong to no surfel
  Echoes glints{};
  DoubleEchoes doubles{};
  std::size_t unreached = 0;  ///< legs of such echoes and of glints that no ray of the profile has
};

/// Returns the surfels that the head sees, with their counts; sets ping.view.sampling.energy.
VisibleSurfels visible_surfels(const PreparedScene& prepared, ResolvedPing& ping);

/// Samples the view, where rays are bent if the options say so; reports refraction.
PingParts sample_parts(const PreparedScene& prepared, ResolvedPing& ping, PingReport& report);

/// Returns the direct echoes of all patches, moved if the options say so. Refers to all arguments, of which it changes
/// parts.direct.
std::unique_ptr<const EchoStream> direct_stream(const SceneCloud& scene, const ResolvedPing& ping, PingParts& parts);

/// Finds the echoes by way of the boundaries and of the mirrors, if the options say so. An echo by a boundary may
/// arrive in a main lobe where the direct one arrives in a side lobe. All visible surfels are therefore split as finely
/// as in main lobes, apart from the direct echoes, whose scatterers stay the same.
void find_bounces(const PreparedScene& prepared, const ResolvedPing& ping, PingParts& parts);

/// Finds the echoes by way of two surfaces (E158), if the options say so.
void find_double_echoes(const PreparedScene& prepared, const ResolvedPing& ping, PingParts& parts);

/// Adds the layers of echoes by way of boundaries, of mirrors and of two surfaces that the options ask for.
void add_paths(const ResolvedPing& ping, const PingParts& parts, LayerSum& layers);

/// Draws the display cells of all echoes and noise (E180): the ping of `result`.
void draw_cells(const SceneCloud& scene, const ResolvedPing& ping, const PingParts& parts,
                SynthesizerTable& synthesizers, SimulatedPing& result);

/// Returns the soundings of a ping. Their contributors may be double echoes, if there are any.
Soundings detect(const SceneCloud& scene, const ResolvedPing& ping, const EchoStream& direct, const PingParts& parts,
                 const Ping& image);

/// Echoes of the water and the boundaries themselves: one entry for each kind that the environment has.
struct Reverberation {
  const char* name;
  Echoes echoes;
};
std::vector<Reverberation> reverberation_echoes(const ResolvedPing& ping);

/// Moves the sampling into `result`, whose ping is complete, and adds medium, noise floor and notes; and what the
/// options ask for: mask of holes, contributors (E63), paths of sound.
void attach_outputs(const PreparedScene& prepared, const ResolvedPing& ping, PingParts parts, SimulatedPing& result);

}  // namespace insonify
