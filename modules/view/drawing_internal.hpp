#pragma once
#include <cstddef>
#include <vector>

#include "view/canvas_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/line_chart_internal.hpp"
#include "view/picture.hpp"
#include "view/show_panels.hpp"
#include "view/show_spectrum.hpp"
#include "view/show_waterfall.hpp"

namespace insonify {

/// Draw onto a canvas without writing a file. Each drawing fills options.width x options.height pixels from the
/// canvas's origin, so that several can share one picture. The caller has checked image and size, and keeps VtkMessages
/// alive. Throw Error(argument), in the name of canvas.who(), for contradictory level limits. Fans and charts return
/// their layout relative to the origin.
FanLayout draw_fan(Canvas& canvas, const LevelImage& image, const PictureOptions& options);
void draw_rect(Canvas& canvas, const LevelImage& image, const PictureOptions& options);
void draw_waterfall(Canvas& canvas, const PingHistory& history, const PictureOptions& options);
Axes draw_ascan(Canvas& canvas, const LevelImage& image, std::size_t beam, const PictureOptions& options);
void draw_pattern(Canvas& canvas, const std::vector<double>& azimuth, const std::vector<double>& level_db,
                  const PictureOptions& options);
void require_pattern(const std::vector<double>& azimuth, const std::vector<double>& level_db, const char* who);
Axes draw_line_chart(Canvas& canvas, const LineChart& chart, const PictureOptions& options);
void draw_spectrum(Canvas& canvas, const std::vector<SpectrumLine>& lines, const PictureOptions& options);
void draw_panels(Canvas& canvas, const Panels& panels, const PictureOptions& options);

}  // namespace insonify
