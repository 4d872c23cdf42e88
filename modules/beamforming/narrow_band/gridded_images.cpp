#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/gridded_synthesis_internal.hpp"
#include "beamforming/narrow_band/image_by_tiles_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t slab_tiles = 8;  // more of them: fewer parts made twice, and more memory for each thread

}  // namespace

template <typename Real>
GriddedImage GriddedSynthesis<Real>::image(const Echoes& echoes) const {
  const bool moving = !echoes.doppler.empty();
  const GriddingInput input{echoes, reach_of(moving), plan_.common_shape && !moving,
                            gridding_unit(echoes, plan_.medium, threads_)};
  return stored_image(input, plan_, tiles_, threads_, [&](auto&... arguments) { return form_beams(arguments...); });
}

template <typename Real>
GriddedImage GriddedSynthesis<Real>::image(const EchoStream& stream) const {
  return streamed_image(stream, plan_, tiles_, reach_of(stream.moving()), slab_tiles, threads_,
                        [&](auto&... arguments) { return form_beams(arguments...); });
}

template <typename Real>
double GriddedSynthesis<Real>::form_beams(GridTile<Real>& tile, double unit, std::size_t first, std::size_t last,
                                          ComplexGrid& pressure) const {
  tile.restore_flushed_sums();
  const std::size_t from = plan_.margin * plan_.stride;
  const double energy = to_beams_.run({tile.re.data() + from, tile.im.data() + from, plan_.stride}, tile.grid.data(),
                                      beams_, unit, first, last, pressure);
  tile.clear();
  return energy;
}

template GriddedImage GriddedSynthesis<float>::image(const Echoes&) const;
template GriddedImage GriddedSynthesis<double>::image(const Echoes&) const;
template GriddedImage GriddedSynthesis<float>::image(const EchoStream&) const;
template GriddedImage GriddedSynthesis<double>::image(const EchoStream&) const;

}  // namespace insonify
