// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "beamforming/synthesize.hpp"
#include "core/units.hpp"
#include "sonar/beam_pattern.hpp"
#include "sonar/shading.hpp"
#include "thesis/thesis.hpp"
#include "view/line_chart_internal.hpp"
#include "view/show_image.hpp"

namespace insonify::thesis {
namespace {

constexpr double wavelength = speed_of_sound / 900e3;

/// Bearings of pictures are positive to starboard.
double bearing_deg(double azimuth) { return -degrees(azimuth); }

std::vector<double> bearings_deg(const std::vector<double>& azimuth) {
  std::vector<double> bearings;
  for (const double a : azimuth) bearings.push_back(bearing_deg(a));
  return bearings;
}

LineChart bearing_chart(double limit_deg, const std::string& title) {
  LineChart chart;
  chart.low_x = -limit_deg, chart.high_x = limit_deg;
  chart.title = title;
  chart.x_title = "Bearing, positive to starboard";
  chart.x_ticks = [limit_deg](double most) { return bearing_labels(-limit_deg, limit_deg, most); };
  return chart;
}

/// One of the thesis' cases with the data of its figures.
struct Simulated {
  Case which;
  Scatterers object;
  SonarHead head;
  Echoes echoes;
  ComplexGrid beams;

  Simulated(std::size_t count, double bin_size)
      : which{count},
        object(make_object(which)),
        head(make_sonar(count, 144, bin_size)),
        echoes(echoes_of_object(object)),
        beams(synthesize_direct(echoes, head, medium())) {}
};

/// Level of one range in all beams [dB re the highest of them, at least -60].
std::vector<double> slice_db(const ComplexGrid& pressure, const RangeGate& gate, double range) {
  const auto bin = static_cast<Eigen::Index>((range - gate.min_range) / gate.bin_size);
  const double highest = pressure.col(bin).abs().maxCoeff();
  std::vector<double> level;
  for (const auto& p : pressure.col(bin)) level.push_back(std::max(-60.0, db_from_amplitude(std::abs(p) / highest)));
  return level;
}

class Figures {
 public:
  explicit Figures(const FigureOptions& options) : options_(options) {
    picture_.width = options.width, picture_.height = options.height;
  }

  void chart(const std::string& name, const LineChart& chart) {
    draw_line_chart(chart, picture_, "02_thesis", path(name));
  }
  void image(const std::string& name, const std::string& title, const SonarHead& head, const ComplexGrid& pressure) {
    // Average the intensity of ten bins, 1 cm, per cell.
    constexpr Eigen::Index together = 10;
    Grid<float> level(pressure.rows(), pressure.cols() / together);
    for (Eigen::Index b = 0; b < level.rows(); ++b)
      for (Eigen::Index cell = 0; cell < level.cols(); ++cell)
        level(b, cell) = static_cast<float>(
            pressure_level_db(std::sqrt(pressure.row(b).segment(together * cell, together).abs2().mean())));
    const double cell_size = together * head.gate.bin_size;
    const RangeGate gate{head.gate.min_range,
                         head.gate.min_range + cell_size * (static_cast<double>(level.cols()) - 0.5), cell_size};
    PictureOptions picture = picture_;
    picture.title = title;
    picture.colour_map = "viridis";
    picture.max_db = 160, picture.min_db = 115;
    picture.width = picture.width * 5 / 8, picture.height = picture.height * 5 / 8;
    show_rect({head.fan, gate, level, "dB re 1 µPa"}, picture, path(name));
  }

 private:
  std::string path(const std::string& name) const {
    const std::string path = options_.folder + "/" + name + ".png";
    fmt::print("wrote {}\n", path);
    return path;
  }

  FigureOptions options_;
  PictureOptions picture_;
};

void draw_object(Figures& figures, const Simulated& s, const std::string& name) {
  LineChart chart = bearing_chart(25, "The object: " + std::to_string(s.which.beams) + " columns of 21 scatterers");
  chart.y_title = "Range [m]";
  chart.low_y = 1.4, chart.high_y = 3.1;
  chart.lines[0].style = LineStyle::points;
  chart.lines[0].x = bearings_deg(s.object.azimuth);
  chart.lines[0].y = s.object.range;
  figures.chart(name, chart);
}

LineChart time_chart(const SonarHead& head, const ComplexGrid& series, std::size_t row) {
  LineChart chart;
  const double ms = 2e3 / speed_of_sound;  // per metre, two way
  chart.low_x = ms * head.gate.min_range, chart.high_x = ms * head.gate.max_range;
  chart.low_y = 90, chart.high_y = 160;
  chart.x_title = "Time since transmission [ms]";
  chart.y_title = "Level [dB re 1 µPa]";
  for (std::size_t n = 0; n < head.gate.bins(); ++n) {
    chart.lines[0].x.push_back(ms * head.gate.centre(n));
    chart.lines[0].y.push_back(std::max(0.0, pressure_level_db(std::abs(series(row, n)))));
  }
  return chart;
}

/// Figures 14 and 15: the middle column alone, and the beam in its direction; prints the deviations of the peaks from
/// 2 r / c and from the sonar equation.
void draw_series(Figures& figures, const Simulated& s, const ComplexGrid& columns) {
  constexpr std::size_t middle = 25;
  LineChart alone = time_chart(s.head, columns, middle);
  alone.title = "Column 26 alone, before beams are formed";
  alone.lines[0].name = "simulated";
  ChartLine expected{{}, {}, "2r/c and SL - 2TL + TS", LineStyle::points};
  double off_sample = 0, off = 0, off_db = 0;
  for (std::size_t i = 0; i < s.object.size(); ++i) {
    const double r = s.object.range[i];
    const double decay = std::exp(-2 * medium().absorption.a0 * r);
    const double level = pressure_level_db(std::abs(s.echoes.amplitude[i]) * decay);
    const Peak peak = find_peak(columns, i / s.which.rays, s.head.gate, r, 0.02);
    off_sample = std::max(off_sample, std::abs(peak.sample_range / r - 1));
    off = std::max(off, std::abs(peak.range - r));
    off_db = std::max(off_db, std::abs(peak.level_db - level));
    if (i / s.which.rays != middle) continue;
    expected.x.push_back(2e3 * r / speed_of_sound);
    expected.y.push_back(level);
  }
  alone.lines.push_back(expected);
  figures.chart("figure14", alone);

  LineChart formed = time_chart(s.head, s.beams, middle);
  formed.title = "Beam 26, after beams are formed";
  formed.lines[0].name = "beam 26";
  formed.lines.push_back({alone.lines[0].x, alone.lines[0].y, "column 26 alone", LineStyle::dashed});
  figures.chart("figure15", formed);
  fmt::print("| travel time, highest sample | {:.2g} % off 2r/c at most |\n", 100 * off_sample);
  fmt::print("| travel time, between samples | {:.1g} mm off 2r/c at most, {} peaks |\n", 1e3 * off, s.object.size());
  fmt::print("| level of a peak | {:.1g} dB off SL - 2TL + TS at most |\n", off_db);
}

/// Figures 17, 19 and 21: the slice, the beam pattern about the scatterer in the middle, and the positions of the
/// others.
void draw_slice(Figures& figures, const Simulated& s, const std::string& name) {
  const std::size_t centre = s.which.period * (s.which.beams / 2 / s.which.period) + 25;
  const std::size_t scatterer = centre * s.which.rays + 10;
  const Echoes one = select(s.echoes, [&](std::size_t i) { return i == scatterer; });
  const ComplexGrid single = synthesize_direct(one, s.head, medium());

  LineChart chart = bearing_chart(22.5, std::to_string(s.which.beams) + " beams: level at 2.25 m against bearing");
  chart.y_title = "Level [dB re the highest]";
  chart.low_y = -40, chart.high_y = 5;
  chart.lines[0].name = "object";
  chart.lines[0].x = bearings_deg(s.head.fan.azimuth);
  chart.lines[0].y = slice_db(s.beams, s.head.gate, slice_range());
  ChartLine there{{}, {}, "scatterers at this range", LineStyle::points};
  double worst = 0;
  const auto bin = static_cast<Eigen::Index>((slice_range() - s.head.gate.min_range) / s.head.gate.bin_size);
  for (std::size_t b = 0; b < s.which.beams; ++b) {
    const double pattern =
        array_response(s.head.array, wavelength, std::sin(s.object.azimuth[scatterer]), std::sin(s.head.fan.azimuth[b]))
            .real();
    worst = std::max(worst, std::abs(single(b, bin) / single(centre, bin) - pattern));
  }
  for (std::size_t column = 25; column < s.which.beams; column += s.which.period)
    there.x.push_back(bearing_deg(s.object.azimuth[column * s.which.rays])), there.y.push_back(2);
  chart.lines.push_back({chart.lines[0].x, slice_db(single, s.head.gate, slice_range()),
                         "one scatterer alone: B(θ - θ0)", LineStyle::dashed});
  chart.lines.push_back(there);
  figures.chart(name, chart);
  fmt::print("| {} beams, one scatterer alone | {:.1g} off B at most |\n", s.which.beams, worst);
}

/// Shows that the thesis' "grating lobes" vanish without the repeated columns, with the same fan and array.
void draw_ghosts(Figures& figures, const Simulated& s) {
  const Echoes once = select(s.echoes, [&](std::size_t i) { return i / s.which.rays / s.which.period == 2; });
  const ComplexGrid beams = synthesize_direct(once, s.head, medium());
  LineChart chart = bearing_chart(22.5, "256 beams: columns 103 to 153 alone");
  chart.y_title = "Level [dB re the highest]";
  chart.low_y = -40, chart.high_y = 5;
  chart.lines[0].name = "columns 103 to 153";
  chart.lines[0].x = bearings_deg(s.head.fan.azimuth);
  chart.lines[0].y = slice_db(beams, s.head.gate, slice_range());
  chart.lines.push_back(
      {chart.lines[0].x, slice_db(s.beams, s.head.gate, slice_range()), "all 256 columns", LineStyle::dashed});
  figures.chart("ghosts", chart);
}

/// True grating lobes: one target received by elements 1.5 wavelengths apart and by a continuous line of that length.
void draw_grating_lobes(Figures& figures) {
  constexpr double limit_deg = 80, target = radians(-10), pitch = 1.5;
  SonarHead head = make_sonar(641);
  for (std::size_t b = 0; b < 641; ++b) head.fan.azimuth[b] = radians(limit_deg * (1 - static_cast<double>(b) / 320));
  Scatterers one;
  one.range = {2.25}, one.azimuth = {target}, one.elevation = {0};
  const std::vector<double> sigma{1};
  const std::vector<std::complex<double>> xi{1};
  const Echoes echo = target_echoes(one, sigma, xi, head.pulse, medium());
  const auto slice = [&](const LineArray& array) {
    head.array = array;
    return slice_db(synthesize_direct(echo, head, medium()), head.gate, 2.25);
  };

  LineChart chart = bearing_chart(limit_deg, "One target at +10°: six elements 1.5 wavelengths apart");
  chart.y_title = "Level [dB re the highest]";
  chart.low_y = -40, chart.high_y = 5;
  chart.lines[0].x = bearings_deg(head.fan.azimuth);
  chart.lines[0].name = "six elements";
  chart.lines[0].y = slice({pitch * wavelength, uniform_shading(6)});
  ChartLine lobes{{}, {}, "sin g = sin s + n λ/d", LineStyle::points};
  for (int n = -3; n <= 3; ++n) {
    const double sine = std::sin(target) + n / pitch;
    if (std::abs(sine) <= 1) lobes.x.push_back(bearing_deg(std::asin(sine))), lobes.y.push_back(0);
  }
  chart.lines.push_back(
      {chart.lines[0].x, slice({9 * wavelength / 144, uniform_shading(144)}), "continuous line", LineStyle::dashed});
  chart.lines.push_back(lobes);
  figures.chart("grating_lobes", chart);
}

void print_pattern_numbers() {
  const LineArray line = aperture(144);
  const BeamPatternReport report = measure_beam_pattern(line, wavelength, 0);
  fmt::print("| beam width | {:.6f} rad |\n| first null | {:.2f} deg |\n", report.width,
             degrees(report.first_null.value_or(0)));
  fmt::print("| highest side lobe | {:.2f} dB |\n", report.highest_side_lobe_db);
  fmt::print("| absorption at 900 kHz, 10 deg C | {:.4f} dB/m |\n", absorption_db_per_m({}, 900e3));
}

}  // namespace

void draw_figures(const FigureOptions& options) {
  Figures figures(options);
  const char* const names[][3] = {
      {"figure16", "figure17", "51"}, {"figure18", "figure19", "101"}, {"figure20", "figure21", "256"}};
  for (const auto& [image, slice, beams] : names) {
    const Simulated s(std::stoul(beams), options.bin_size);
    const ComplexGrid columns = column_series(s.echoes, s.which, s.head);
    const std::string title = std::string(beams) + " beams";
    if (s.which.beams == 51) draw_object(figures, s, "figure13"), draw_series(figures, s, columns);
    figures.image(std::string(image) + "_columns", title + ": columns alone", s.head, columns);
    figures.image(image, title + ": after beams are formed", s.head, s.beams);
    draw_slice(figures, s, slice);
    if (s.which.beams != 256) continue;
    draw_object(figures, s, "object256");
    draw_ghosts(figures, s);
  }
  draw_grating_lobes(figures);
  print_pattern_numbers();
}

}  // namespace insonify::thesis
