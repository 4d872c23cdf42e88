#pragma once
#include <string>
#include <vector>

#include "tool/image_run.hpp"

namespace insonify::tool {

/// One picture to draw: a ping of a run (a waterfall shows all pings), with title and marks in `picture`.
struct ViewJob {
  const ImageRun& run;
  const ImageOptions& options;
  const PictureOptions& picture;
  std::size_t ping = 0;
  std::string path;
};

/// Where on the beam axis a view looks.
enum class BeamChoice { one, strongest, mean };
struct ChosenBeam {
  BeamChoice choice = BeamChoice::one;
  std::size_t beam = 0;  ///< of `one`
};

/// A view: a row of the table from which --view, its help and its checks are made. A new view is a drawing function and
/// its row in image_views.cpp.
struct ViewSpec {
  const char* name;
  const char* shows;                           ///< what --help says
  std::vector<std::string> options = {};       ///< that this view takes and not all views do
  void (*draw)(const ViewJob& job) = nullptr;  ///< of a run that has been read
  /// The highest level that the view chooses for a ping if --max is not given; a series of pictures takes the highest
  /// of all pings, so that it does not flicker. Null for a view that makes no series (--animate).
  double (*max_db)(const ImageRun& run, const ImageOptions& options, std::size_t ping) = nullptr;
  const char* beam_word = "";                   ///< that --beam takes beside a number
  BeamChoice beam_choice = BeamChoice::one;     ///< that the word means
  BeamChoice default_choice = BeamChoice::one;  ///< without --beam
  /// Set for a view that reads what it draws by itself, in place of `draw`.
  void (*draw_alone)(const ImageOptions& options, const PictureOptions& picture) = nullptr;
};

const std::vector<ViewSpec>& all_views();
const ViewSpec& view_of(const ImageOptions& options);

/// Names of the views that take an option, as "fan, rect or panels".
std::string views_with(const std::string& option);

/// --beam: a number, the word of the view, or empty: the view's default, of one beam the middle one. Throws
/// Error(argument).
ChosenBeam choose_beam(const ImageOptions& options, std::size_t beams);

/// The title of the picture of a ping where the user gives none.
std::string default_title(const ImageRun& run, const ImageOptions& options, std::size_t ping);

}  // namespace insonify::tool
