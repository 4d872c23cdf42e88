// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "view/axes_internal.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/off_screen_internal.hpp"

namespace insonify {

using Colour = std::array<double, 3>;

/// Colours of everything but the data.
struct Theme {
  Colour background, text, line;
};
Theme theme(bool dark);

/// Thin lines over the data, visible on dark and bright cells.
constexpr Colour grid_colour = {0.8, 0.83, 0.86};
constexpr double grid_opacity = 0.3;

/// Returns red, green and blue of a colour, each in [0, 1].
inline Colour shares_of(const Rgb& rgb) { return {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0}; }

/// Returns a closed ring with this number of corners.
Path ring(Point2 centre, double radius, int corners);

/// A map from bearing [rad] and range [m] to a position in the picture.
using PlaneProjection = std::function<Point2(double bearing, double range)>;

/// An off-screen picture. Coordinates are pixels from its lower left corner, or from an origin within it, so that
/// several drawings can share one picture. Lines and edges of cells are smoothed by four samples per pixel; a pixel
/// inside one cell has exactly that cell's colour.
class Canvas {
 public:
  Canvas(const PictureOptions& options, const char* who);

  /// Draws into a renderer of the caller's window and sets its camera to show options.width x options.height pixels.
  /// The drawing follows when that camera moves. png() does not apply to such a canvas.
  Canvas(vtkRenderer* renderer, const PictureOptions& options, const char* who);

  /// Sets the position in the picture of (0, 0) for everything added later; whole pixels.
  void set_origin(Point2 origin);
  Point2 origin() const { return origin_; }

  /// Draws a patch of cells. `largest_step` [rad] bounds how far a bearing may turn along a straight edge.
  void add_cells(const CellPatch& patch, const std::vector<double>& beam_edges, const ColourScale& scale,
                 const PlaneProjection& projection, double largest_step);
  /// Draws cells of a grid, `columns` to a row, row after row from below, that fill a box.
  void add_image(const Box& box, int columns, const std::vector<Rgb>& cells);
  void add_lines(const std::vector<Path>& paths, double width, const Colour& colour, double opacity);
  /// Draws a filled rectangle behind everything else, in any order of drawing.
  void add_plate(const Box& box, const Colour& colour, double opacity);
  void add_text(const PlacedText& text);
  /// Draws a text from a position at the middle of its height, fitted into a width [pixels]; returns its end.
  double add_text_from(Point2 left, const std::string& text, int font_size, double width);
  void add_colour_bar(const ColourBar& bar, const ColourScale& scale, double line_width);

  vtkRenderer* renderer() { return renderer_; }
  const char* who() const { return who_; }
  const Theme& colours() const { return theme_; }
  /// Returns all texts added so far, in picture coordinates.
  const std::vector<PlacedText>& texts() const { return texts_; }

  /// Renders, and returns the bytes of a PNG. Throws Error(runtime) if VTK reported an error.
  std::string png(const VtkMessages& messages);

 private:
  void add_quads(const std::vector<Point2>& corners, double height, const Colour& colour, double opacity);
  void add_textured_strip(const std::vector<Point2>& points, const std::vector<Point2>& texture_points,
                          vtkImageData* colours);

  const char* who_;
  int width_, height_;
  Point2 origin_;
  Theme theme_;
  std::vector<PlacedText> texts_;
  vtkSmartPointer<EglWindow> window_;  ///< null if the caller owns the window
  vtkSmartPointer<vtkRenderer> renderer_;
};

/// Draws a picture off-screen and writes it. Errors as save_drawing.
void save_picture(const PictureOptions& options, const char* who, const std::string& png_path,
                  const std::function<void(Canvas&)>& draw);

/// Sets the font: DejaVu Sans if installed, else a similar one, else VTK's built-in font (which lacks Greek: see
/// readable_text).
void set_font(vtkTextProperty* property, int font_size);

/// Returns the actor of a text in the colours of a theme. It is anchored at its first letter, which stands on whole
/// pixels to keep letters sharp; positions are in `coordinates`, VTK_DISPLAY, VTK_VIEWPORT or VTK_WORLD.
vtkSmartPointer<vtkTextActor> text_actor(const PlacedText& text, const Theme& theme, int coordinates);

/// Returns the text, with µ written as u if only VTK's built-in font is available.
std::string readable_text(const std::string& text);

}  // namespace insonify
