#pragma once
#include <string>

#include "view/picture.hpp"

namespace insonify {

/// Draws the fan in its true geometry (each sample a cell of a curvilinear grid, nothing resampled) into a
/// PNG, without an X server: starboard on the right, bearings labelled positive to starboard, range rings
/// [m], colour bar with unit and reference, title. Bearings are labelled positive to starboard: this flip
/// lives in `view` alone.
///
/// A cell reaches halfway to its neighbours in azimuth, in whatever order the beams come; fans across the
/// stern and full circles are one piece. Of beams of one azimuth but several elevations the strongest is drawn, range
/// by range, and the colour bar says so. Display product: cells smaller than half a pixel (more than two bins per pixel of radius, or
/// beams near the apex) are combined with their neighbours by mean power first, so none vanishes by chance. A
/// larger picture shows them singly. Two renderings of one image on one machine have the same bytes.
///
/// Written to a temporary name, then renamed. Throws Error(runtime) if no off-screen GL can be had,
/// Error(argument) for an unknown colour map, an image whose sizes differ, or a picture not of 240 to 8192
/// pixels either way, Error(file) if the PNG cannot be written. May be called from several threads; they take
/// turns.
void show_fan(const LevelImage& image, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
