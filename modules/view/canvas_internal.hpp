#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "view/colour_bar.hpp"
#include "view/drawn_cells.hpp"
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
using Projection = std::function<Point2(double bearing, double range)>;

/// An off-screen picture, drawn in pixels from its lower left corner. Lines and edges of cells are smoothed
/// by four samples per pixel; a pixel inside one cell has exactly that cell's colour.
class Canvas {
 public:
  Canvas(const PictureOptions& options, const char* who);

  /// Draws a patch of cells. `largest_step` [rad] bounds how far a bearing may turn along a straight edge.
  void add_cells(const CellPatch& patch, const std::vector<double>& beam_edges, const ColourScale& scale,
                 const Projection& projection, double largest_step);
  void add_lines(const std::vector<Path>& paths, double width, const Colour& colour, double opacity);
  void add_text(const PlacedText& text);
  void add_colour_bar(const ColourBar& bar, const ColourScale& scale, double line_width);

  vtkRenderer* renderer() { return renderer_; }
  const Theme& colours() const { return theme_; }

  /// Draws all of it and writes it as PNG. Throws Error(runtime) if VTK has complained, and Error(file).
  void save_png(const std::string& path, const VtkMessages& messages);

 private:
  void add_textured_strip(const std::vector<Point2>& points, const std::vector<Point2>& texture_points,
                          vtkImageData* colours);

  const char* who_;
  int width_, height_;
  Theme theme_;
  vtkSmartPointer<EglWindow> window_;
  vtkNew<vtkRenderer> renderer_;
};

}  // namespace insonify
