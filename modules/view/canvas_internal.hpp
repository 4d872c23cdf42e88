#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "view/colour_bar_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/egl_window_internal.hpp"
#include "view/vtk_messages_internal.hpp"

namespace insonify {

using Colour = std::array<double, 3>;

/// Colours of everything but the data.
struct Theme {
  Colour background, text, line;
};
Theme theme(bool dark);

/// Thin lines over the data: seen on dark cells and bright ones, yet not in the way.
constexpr Colour grid_colour = {0.8, 0.83, 0.86};
constexpr double grid_opacity = 0.3;

/// Where bearing [rad] and range [m] go.
using PlaneProjection = std::function<Point2(double bearing, double range)>;

/// An off-screen picture, drawn in pixels from its lower left corner, or from an origin within it, so that several
/// drawings share one picture. Lines and edges of cells are smoothed by four samples per pixel; a pixel inside one cell
/// has exactly that cell's colour.
class Canvas {
 public:
  Canvas(const PictureOptions& options, const char* who);

  /// Draws into a renderer of somebody else's window: options.width x options.height pixels, which its camera is made to
  /// show. Everything follows when that camera moves. save_png is not for such a canvas.
  Canvas(vtkRenderer* renderer, const PictureOptions& options, const char* who);

  /// Where (0, 0) of all that is added from now on lies in the picture; whole pixels.
  void set_origin(Point2 origin);
  Point2 origin() const { return origin_; }

  /// Draws a patch of cells. `largest_step` [rad] bounds how far a bearing may turn along a straight edge.
  void add_cells(const CellPatch& patch, const std::vector<double>& beam_edges, const ColourScale& scale,
                 const PlaneProjection& projection, double largest_step);
  void add_lines(const std::vector<Path>& paths, double width, const Colour& colour, double opacity);
  void add_text(const PlacedText& text);
  void add_colour_bar(const ColourBar& bar, const ColourScale& scale, double line_width);

  vtkRenderer* renderer() { return renderer_; }
  const char* who() const { return who_; }
  const Theme& colours() const { return theme_; }
  /// All texts so far, where they stand in the picture.
  const std::vector<PlacedText>& texts() const { return texts_; }

  /// Draws all of it and writes it as PNG. Throws Error(runtime) if VTK has complained, and Error(file).
  void save_png(const std::string& path, const VtkMessages& messages);

 private:
  void add_textured_strip(const std::vector<Point2>& points, const std::vector<Point2>& texture_points,
                          vtkImageData* colours);

  const char* who_;
  int width_, height_;
  Point2 origin_;
  Theme theme_;
  std::vector<PlacedText> texts_;
  vtkSmartPointer<EglWindow> window_;  ///< its own, or none
  vtkSmartPointer<vtkRenderer> renderer_;
};

}  // namespace insonify
