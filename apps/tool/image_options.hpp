#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "tool/options.hpp"

namespace insonify::tool {

/// Options of `image`.
struct ImageOptions {
  CommonOptions common;
  std::string run;
  std::string output;
  std::string view = "fan";
  std::string layer;  ///< name, or empty: the whole pressure
  std::string colour_map = "copper";
  std::string size = "1400x1050";
  std::string title;
  double window_db = 45;
  std::string max_db;  ///< or empty: automatic
  std::uint64_t ping = 0;
  std::string beam;                     ///< number, a word of the view, or empty: the default of the view
  std::optional<std::string> annotate;  ///< number of maxima, .csv file, or "": five maxima
  bool animate = false;
  bool force = false;
  bool raw = false;
  double tvg = 40;  ///< [dB per decade of range]
  int bits = 8;     ///< of view grey
  bool dark = false;
  // Of view scene:
  std::string scene;               ///< of a run, or empty: where run.toml says
  std::string sonar, pose, range;  ///< to inspect a scene
  std::string world = "z-up";
  std::string camera = "auto", colour;  ///< colour empty: the default of run or scene
  bool normals = false;                 ///< drawn as lines
};

}  // namespace insonify::tool
