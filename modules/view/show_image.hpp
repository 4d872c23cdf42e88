// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "returns/bottom_detection.hpp"
#include "view/picture.hpp"

namespace insonify {

/// Draws the fan in its true geometry (each sample a cell of a curvilinear grid, without resampling) into a PNG,
/// without an X server: starboard on the right, range rings [m], colour bar with unit and reference, title. Bearings
/// are labelled positive to starboard: only `view` makes this flip.
///
/// A cell extends halfway to its neighbours in azimuth, for any order of beams. Fans across the stern and full circles
/// stay in one piece. Beams of one azimuth and several elevations share a cell, which shows the strongest at each
/// range; the colour bar notes this. Cells smaller than half a pixel (more than two bins per pixel of radius, or beams
/// near the apex) are first averaged in power with their neighbours, so none is lost; a larger picture shows them
/// individually. Two renderings of one image on one machine have the same bytes.
///
/// Written to a temporary name, then renamed. Throws Error(runtime) without off-screen GL, Error(argument) for an
/// unknown colour map, an image of inconsistent size, or a width or height not within 240 to 8192 pixels, Error(file)
/// if the PNG cannot be written. Thread-safe; calls are serialised.
void show_fan(const LevelImage& image, const PictureOptions& options, const std::string& png_path);

/// Draws beams x range as a rectangle: bearing (positive to starboard, on the right) across, range upwards,
/// axes with units, colour bar, title. Files and errors as show_fan.
void show_rect(const LevelImage& image, const PictureOptions& options, const std::string& png_path);

/// Writes grey values (beams x bins) as a picture with one pixel per sample. Beams are columns, ordered by bearing,
/// starboard right. Range increases upwards (the first row of the file is the farthest bin), as in show_rect. Beams of
/// equal azimuth are adjacent in the order of the fan. The extension .png or .pgm selects PNG or PGM (P5); the type of
/// the values selects 8 or 16 bits. Throws Error(argument) for another extension, an empty picture, or a number of
/// beams that is not the fan's; Error(file) if it cannot write.
void show_grey(const Grid<std::uint8_t>& grey, const BeamFan& fan, const std::string& path);
/// Writes grey values of 16 bits in the same way.
void show_grey(const Grid<std::uint16_t>& grey, const BeamFan& fan, const std::string& path);

/// Draws the level of one beam against range as a chart with units; the title begins with beam and bearing.
/// min_db and max_db limit the level axis; an automatic max_db is the next multiple of 5 dB above the beam's
/// highest level. Files and errors as show_fan; also Error(argument) unless beam < beams.
void show_ascan(const LevelImage& image, std::size_t beam, const PictureOptions& options, const std::string& png_path);

/// Draws the level of a beam [dB re its peak] against bearing in degrees, positive to starboard, as a chart. `azimuth`
/// [rad] in head axes (positive to port), monotonic; levels of -inf (nulls) are not drawn. min_db and max_db limit the
/// level axis; defaults are -60 and 0. Files as show_fan; Error(argument) unless there are at least two points, as many
/// levels as azimuths, all azimuths finite, no level NaN, and max_db > min_db.
void show_pattern(const std::vector<double>& azimuth, const std::vector<double>& level_db,
                  const PictureOptions& options, const std::string& png_path);

/// A fact about a ping, e.g. "Pose", "0, 0, -3 m".
struct Fact {
  std::string name, value;
};

/// The contents of a summary picture of one ping.
struct Panels {
  LevelImage image;
  std::size_t beam = 0;                     ///< beam of the A-scan
  std::vector<double> azimuth, pattern_db;  ///< beam pattern, as for show_pattern; empty: unknown
  std::string pattern_title;
  std::vector<Fact> facts;
};

/// Draws the fan, the A-scan of one beam, its pattern (or, if unknown, beams x range as show_rect) and a table of facts
/// into one picture with the title on top; marks are drawn on the fan. Files and errors as show_fan, show_ascan and
/// show_pattern; also Error(argument) for a picture smaller than 640 x 480.
void show_panels(const Panels& panels, const PictureOptions& options, const std::string& png_path);

/// A power spectral density to be drawn.
struct SpectrumLine {
  std::vector<double> frequency;  ///< [Hz], ascending
  std::vector<double> density;    ///< [Pa^2/Hz]
  std::string name;               ///< name in the legend
};

/// Draws densities [dB re 1 µPa²/Hz] against frequency [kHz] as a chart with a legend, the first one as a solid line
/// and the others dashed over it. min_db and max_db limit the level axis; defaults are the next multiples of 5 dB
/// beyond the extremes of all lines, at most window_db apart. Files as show_fan; Error(argument) unless there is at
/// least one line, each with at least two points, finite ascending frequencies, as many densities, and none of them
/// negative or NaN.
void show_spectrum(const std::vector<SpectrumLine>& lines, const PictureOptions& options, const std::string& png_path);

/// Levels along one beam, ping after ping.
struct PingHistory {
  std::vector<std::int64_t> number;  ///< numbers of the pings, oldest first
  std::vector<double> time;          ///< times of their transmission [s]
  RangeGate gate;                    ///< two sides: from -max_range, far to port, to max_range, far to starboard
  Grid<float> level_db;              ///< pings x bins
  std::string unit;                  ///< unit of the colour bar, see LevelImage::unit
  std::string range_title = "Range [m]";
};

/// Draws pings x range as a waterfall with colour bar and title. Each ping is a row, the newest on top. Range increases
/// to the right; for two sides it increases from the middle outwards. Rows have equal height for any time between pings
/// and are labelled by ping number. Rows and bins smaller than half a pixel are averaged in power, as in show_fan.
/// Files and errors as show_fan; also Error(argument) for fewer than two pings, or if numbers, times and rows differ in
/// count.
void show_waterfall(const PingHistory& history, const PictureOptions& options, const std::string& png_path);

/// Returns the `count` strongest local maxima of an image, strongest first. A maximum is a cell that is no weaker than
/// its neighbours in bearing and range, stronger than the weakest sample, and at most `within_db` below the strongest
/// cell. Maxima are at least a twentieth of the outer range apart in the plane. The name of a maximum holds its range,
/// bearing and level in the image: "12.4 m, +5.2°, 93.1 dB". For beams of one bearing the strongest is used, as in
/// show_fan. Throws Error(argument) for an invalid image or unless within_db > 0.
std::vector<Mark> strongest_maxima(const LevelImage& image, std::size_t count, double within_db);

/// Draws soundings of the bottom as points: distance across the track to starboard from the head, and height in the
/// world [m]. Soundings by amplitude, soundings by phase, and rejected ones have different marks. Files as show_fan;
/// Error(content) without soundings.
void show_soundings(const Ping& ping, const BottomSoundings& found, const PictureOptions& options,
                    const std::string& png_path);

}  // namespace insonify
