#pragma once
#include <string>

#include "view/picture.hpp"

namespace insonify {

/// Draws the fan in its true geometry (each sample a cell of a curvilinear grid, without resampling) into a PNG,
/// without an X server: starboard on the right, range rings [m], colour bar with unit and reference, title. Bearings
/// are labelled positive to starboard: only `view` makes this flip.
///
/// A cell extends halfway to its neighbours in azimuth, in any order of beams; fans across the stern and full circles
/// stay in one piece. Of beams of one azimuth and several elevations the strongest is drawn at each range, which the
/// colour bar notes. Cells smaller than half a pixel (more than two bins per pixel of radius, or beams near the apex)
/// are first averaged in power with their neighbours, so none is lost; a larger picture shows them individually. Two
/// renderings of one image on one machine have the same bytes.
///
/// Written to a temporary name, then renamed. Throws Error(runtime) without off-screen GL, Error(argument) for an
/// unknown colour map, an image of inconsistent size, or a width or height not within 240 to 8192 pixels, Error(file)
/// if the PNG cannot be written. Thread-safe; calls are serialised.
void show_fan(const LevelImage& image, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
