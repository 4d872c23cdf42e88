// SPDX-License-Identifier: BSD-3-Clause
#include "formats/aris_file.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/binary_input_internal.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t aris_header_bytes = 1024;
constexpr std::uint32_t aris_version = 0x05464444, aris_swapped = 0x44444605;  // "DDF" and 5, in either byte order
constexpr std::uint32_t aris_3000 = 1;
constexpr double aris_farthest = 1000;  // [m], beyond any ARIS

/// Offsets in the header of a frame.
enum ArisOffset : std::size_t {
  aris_time = 4,
  aris_frame_version = 12,
  aris_gain = 68,
  aris_temperature = 224,
  aris_mode = 436,
  aris_pulse = 444,
  aris_period = 452,
  aris_speed = 464,
  aris_samples = 468,
  aris_delay = 476,
  aris_lens = 480,
  aris_model = 484,
  aris_ordered = 516
};

std::size_t beams_of_mode(const std::string& path, std::uint32_t mode) {
  constexpr std::size_t beams[] = {0, 48, 48, 96, 96, 96, 64, 64, 64, 128, 128, 128, 128};
  if (mode < 1 || mode > 12) fail(ErrorKind::content, path, ": ping mode ", mode, ", must be 1 to 12");
  return beams[mode];
}

/// Returns the directions of the beams behind the lenses, by polynomials fitted to the tables of the SDK.
BeamFan aris_fan(std::size_t beams, std::uint32_t model, bool telephoto) {
  BeamFan fan;
  const double half = 0.5 * static_cast<double>(beams);
  for (std::size_t b = 0; b < beams; ++b) {
    const double x = (static_cast<double>(b) + 0.5 - half) / half, q = x * x;
    const double bearing = telephoto            ? x * (7.27 - 0.40 * q)
                           : model == aris_3000 ? x * (15.196 - 0.368 * q)
                                                : x * (16.4325 - q * (3.5479 - 0.9105 * q));
    fan.azimuth.push_back(radians(bearing));  // beam 0 is the starboard one
    fan.elevation.push_back(0);
  }
  fan.beam_width = (fan.azimuth.back() - fan.azimuth.front()) / static_cast<double>(beams - 1);
  fan.elevation_width = radians(telephoto ? 3 : 14);
  return fan;
}

void require_version(const std::string& path, const std::string& header, std::size_t offset, const char* what) {
  const auto version = little_at<std::uint32_t>(header, offset);
  if (version == aris_swapped)
    fail(ErrorKind::content, path, ": ", what,
         " is of the other byte order (big-endian); ARIS recordings are little-endian");
  if (version != aris_version)
    fail(ErrorKind::content, path, ": ", what, " does not begin with DDF and 5, so it is no ARIS recording");
}

RangeGate aris_gate(const std::string& path, const std::string& head) {
  const double speed = static_cast<double>(little_at<float>(head, aris_speed));
  const double period = 1e-6 * little_at<std::uint32_t>(head, aris_period);
  const double delay = 1e-6 * little_at<std::uint32_t>(head, aris_delay);
  const auto samples = little_at<std::uint32_t>(head, aris_samples);
  if (!(speed > 1000 && speed < 2000) || !(period > 0) || !(delay > 0) || samples == 0 || samples > 100000)
    fail(ErrorKind::content, path, ": has no geometry: sound speed ", speed, " m/s, sample period ", period,
         " s, delay ", delay, " s, ", samples, " samples; must be 1000 to 2000 m/s and > 0");
  // A sample stands for the range of its index: it is the centre of its bin.
  const double bin = period * speed / 2, first = delay * speed / 2 - bin / 2;
  if (!(first > 0 && first + samples * bin < aris_farthest))
    fail(ErrorKind::content, path, ": its samples reach from ", first, " to ", first + samples * bin,
         " m, must begin above 0 and end below ", aris_farthest, " m; the file is damaged, copy it again");
  RangeGate gate{first, first + samples * bin, bin};
  while (gate.bins() > samples) gate.max_range -= 1e-6 * bin;
  return gate;
}

}  // namespace

ArisFrame read_aris_frame(const std::string& path, std::size_t number) {
  BinaryInput file(path);
  const std::size_t size = file.size();
  require_version(path, file.part(0, aris_header_bytes, "its header"), 0, "the file");
  std::string head = file.part(aris_header_bytes, aris_header_bytes, "the header of frame 0");
  require_version(path, head, aris_frame_version, "frame 0");

  // All frames have the size of the first.
  const std::size_t beams = beams_of_mode(path, little_at<std::uint32_t>(head, aris_mode));
  ArisFrame frame;
  frame.gate = aris_gate(path, head);
  const std::size_t samples = little_at<std::uint32_t>(head, aris_samples);
  const std::size_t stride = aris_header_bytes + beams * samples;
  frame.frames = (size - aris_header_bytes) / stride;
  if (frame.frames == 0 || (size - aris_header_bytes) % stride != 0)
    fail(ErrorKind::content, path, ": ends within frame ", frame.frames, " of ", beams, " beams x ", samples,
         " samples; the file is truncated, copy it again");
  if (number >= frame.frames)
    fail(ErrorKind::argument, path, ": frame ", number, ", must be below the number of frames, ", frame.frames);
  const std::size_t begin = aris_header_bytes + number * stride;
  head = file.part(begin, aris_header_bytes, "the header of a frame");
  require_version(path, head, aris_frame_version, "the frame");
  if (little_at<std::uint32_t>(head, aris_ordered) == 0)
    fail(ErrorKind::content, path, ": samples of frame ", number, " are not in order; save it by the maker's program");
  const std::uint32_t model = little_at<std::uint32_t>(head, aris_model);
  const bool telephoto = little_at<std::uint32_t>(head, aris_lens) != 0;
  frame.model = std::string(model == aris_3000 ? "ARIS 3000"
                            : model == 2       ? "ARIS 1200"
                                               : "ARIS 1800") +
                (telephoto ? ", telephoto lens" : "");
  frame.fan = aris_fan(beams, model, telephoto);
  frame.time = 1e-6 * static_cast<double>(little_at<std::uint64_t>(head, aris_time));
  frame.sound_speed = static_cast<double>(little_at<float>(head, aris_speed));
  frame.temperature_c = static_cast<double>(little_at<float>(head, aris_temperature));
  frame.pulse_length = 1e-6 * little_at<std::uint32_t>(head, aris_pulse);
  frame.receiver_gain_db = little_at<std::uint32_t>(head, aris_gain);

  const std::string data = file.part(begin + aris_header_bytes, beams * samples, "a frame");
  const Eigen::Map<const Grid<std::uint8_t>> rows(reinterpret_cast<const std::uint8_t*>(data.data()),
                                                  static_cast<Eigen::Index>(samples), static_cast<Eigen::Index>(beams));
  frame.grey = rows.transpose();
  return frame;
}

Grid<float> level_db(const ArisFrame& frame) {
  return frame.grey.cast<float>() * static_cast<float>((aris_scale.max_db - aris_scale.min_db) / 255);
}

}  // namespace insonify
