// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "view/canvas_internal.hpp"
#include "view/off_screen_internal.hpp"

namespace insonify {
namespace {

constexpr int samples_per_pixel = 4;
constexpr double plate_height = -1, cells_height = 0, lines_height = 1, eye_height = 10;  // above the picture plane

// Returns an actor in its own colours, without lighting.
vtkNew<vtkActor> flat_actor(vtkPolyData* shape) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

// Returns quads from successive groups of four corners, relative to the origin.
vtkNew<vtkPolyData> quads(const std::vector<Point2>& corners, Point2 origin, double height) {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(corners.size()));
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto id = static_cast<vtkIdType>(i);
    points->SetPoint(id, origin.x + corners[i].x, origin.y + corners[i].y, height);
    if (i % 4 == 0) cells->InsertNextCell({id, id + 1, id + 2, id + 3});
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(cells);
  return shape;
}

// Returns levels as colours, one pixel per cell, bins across, in two columns or more: VTK rotates a single one.
vtkNew<vtkImageData> coloured(const Grid<float>& level_db, const ColourScale& scale) {
  const Eigen::Index columns = std::max<Eigen::Index>(2, level_db.cols());
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(columns), static_cast<int>(level_db.rows()), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* const bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  parallel_for(static_cast<std::size_t>(level_db.rows()), 0, [&](std::size_t r) {
    const auto row = static_cast<Eigen::Index>(r);
    unsigned char* to = bytes + 3 * row * columns;
    for (Eigen::Index column = 0; column < columns; ++column, to += 3) {
      const Rgb colour = scale.colour(level_db(row, std::min(column, level_db.cols() - 1)));
      std::copy(colour.begin(), colour.end(), to);
    }
  });
  return image;
}

// Returns the vector across a path at point i with half the line width; corners are mitred.
Point2 half_width_at(const Path& path, std::size_t i, double half_width) {
  const bool closed = path.front().x == path.back().x && path.front().y == path.back().y;
  const std::size_t last = path.size() - 1;
  const auto normal = [&](std::size_t from, std::size_t to) {
    const double dx = path[to].x - path[from].x, dy = path[to].y - path[from].y;
    const double length = std::max(std::hypot(dx, dy), 1e-12);
    return Point2{-dy / length, dx / length};
  };
  const Point2 before = i > 0 ? normal(i - 1, i) : closed ? normal(last - 1, last) : normal(0, 1);
  const Point2 after = i < last ? normal(i, i + 1) : closed ? normal(0, 1) : normal(last - 1, last);
  const double x = before.x + after.x, y = before.y + after.y;
  const double stretch = half_width / std::max(0.2, (x * x + y * y) / 2);
  return {x * stretch, y * stretch};
}

}  // namespace

Theme theme(bool dark) {
  if (dark) return {{0.055, 0.065, 0.085}, {0.86, 0.88, 0.90}, {0.55, 0.58, 0.62}};
  return {{1, 1, 1}, {0.10, 0.11, 0.13}, {0.35, 0.37, 0.40}};
}

Path ring(Point2 centre, double radius, int corners) {
  Path path;
  for (int i = 0; i <= corners; ++i) {
    const double turn = 2 * pi * (i % corners) / corners;
    path.push_back({centre.x + radius * std::cos(turn), centre.y + radius * std::sin(turn)});
  }
  return path;
}

vtkSmartPointer<vtkTextActor> text_actor(const PlacedText& text, const Theme& theme, int coordinates) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(readable_text(text.text).c_str());
  vtkTextProperty* property = actor->GetTextProperty();
  set_font(property, text.font_size);
  property->SetColor(theme.text[0], theme.text[1], theme.text[2]);
  property->SetOrientation(text.turned ? 90 : 0);
  if (text.on_plate) {
    property->SetBackgroundColor(theme.background[0], theme.background[1], theme.background[2]);
    property->SetBackgroundOpacity(0.65);
  }
  const Box box = text.box();
  actor->GetPositionCoordinate()->SetCoordinateSystem(coordinates);
  actor->SetPosition(std::round(text.turned ? box.right : box.left), std::round(box.bottom));
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
  return actor;
}

Canvas::Canvas(vtkRenderer* renderer, const PictureOptions& options, const char* who)
    : who_(who), width_(options.width), height_(options.height), theme_(theme(options.dark)), renderer_(renderer) {
  renderer_->SetBackground(theme_.background.data());

  // Scale the plane to one unit per pixel.
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(width_ / 2.0, height_ / 2.0, 0);
  camera->SetPosition(width_ / 2.0, height_ / 2.0, eye_height);
  camera->SetParallelScale(height_ / 2.0);
  camera->SetClippingRange(1, 2 * eye_height);
}

Canvas::Canvas(const PictureOptions& options, const char* who)
    : Canvas(vtkSmartPointer<vtkRenderer>::New(), options, who) {
  window_ = vtkSmartPointer<EglWindow>::New();
  window_->SetMultiSamples(samples_per_pixel);
  window_->SetDPI(72);  // one point of text is one pixel
  window_->SetSize(width_, height_);
  window_->open(who);
  window_->AddRenderer(renderer_);
}

void Canvas::set_origin(Point2 origin) { origin_ = {std::round(origin.x), std::round(origin.y)}; }

// Cells are drawn as one texture, a texel per cell, on a mesh with one column of quads per beam. Along a quad
// the range is linear and the beam constant, so every cell has its true position and edges, and a picture of
// millions of cells costs a few hundred polygons and one upload.
void Canvas::add_cells(const CellPatch& patch, const std::vector<double>& beam_edges, const ColourScale& scale,
                       const PlaneProjection& projection, double largest_step) {
  const vtkNew<vtkImageData> colours = coloured(patch.level_db, scale);
  const double far = patch.columns / colours->GetDimensions()[0];
  std::vector<Point2> corners, texture_points;
  for (std::size_t beam = 0; beam + 1 < beam_edges.size(); ++beam) {
    const double row = static_cast<double>(beam / patch.beams_per_row) + 0.5;
    const double v = row / static_cast<double>(patch.level_db.rows());
    const double width = beam_edges[beam + 1] - beam_edges[beam];
    const int steps = std::max(1, static_cast<int>(std::ceil(width / largest_step)));
    for (int step = 0; step < steps; ++step) {
      const double from = beam_edges[beam] + width * step / steps;
      const double to = step + 1 == steps ? beam_edges[beam + 1] : beam_edges[beam] + width * (step + 1) / steps;
      corners.insert(corners.end(), {projection(from, patch.min_range), projection(from, patch.max_range),
                                     projection(to, patch.max_range), projection(to, patch.min_range)});
      texture_points.insert(texture_points.end(), {{0, v}, {far, v}, {far, v}, {0, v}});
    }
  }
  add_textured_strip(corners, texture_points, colours);
}

void Canvas::add_textured_strip(const std::vector<Point2>& points, const std::vector<Point2>& texture_points,
                                vtkImageData* colours) {
  const vtkNew<vtkPolyData> shape = quads(points, origin_, cells_height);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(texture_points.size()));
  for (std::size_t i = 0; i < texture_points.size(); ++i)
    coordinates->SetTuple2(static_cast<vtkIdType>(i), texture_points[i].x, texture_points[i].y);
  shape->GetPointData()->SetTCoords(coordinates);

  vtkNew<vtkTexture> texture;
  texture->SetInputData(colours);
  texture->InterpolateOff();
  texture->MipmapOff();
  texture->RepeatOff();
  const vtkNew<vtkActor> actor = flat_actor(shape);
  actor->SetTexture(texture);
  renderer_->AddActor(actor);
}

void Canvas::add_image(const Box& box, int columns, const std::vector<Rgb>& cells) {
  const vtkNew<vtkImageData> colours;
  colours->SetDimensions(columns, static_cast<int>(cells.size()) / columns, 1);
  colours->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::copy_n(cells.front().data(), 3 * cells.size(), static_cast<std::uint8_t*>(colours->GetScalarPointer()));
  Path corners = outline(box);
  corners.pop_back();
  add_textured_strip(corners, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, colours);
}

void Canvas::add_lines(const std::vector<Path>& paths, double width, const Colour& colour, double opacity) {
  std::vector<Point2> corners;
  for (const Path& path : paths)
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Point2 a = path[i], b = path[i + 1];
      const Point2 at_a = half_width_at(path, i, width / 2), at_b = half_width_at(path, i + 1, width / 2);
      corners.insert(corners.end(), {{a.x + at_a.x, a.y + at_a.y},
                                     {b.x + at_b.x, b.y + at_b.y},
                                     {b.x - at_b.x, b.y - at_b.y},
                                     {a.x - at_a.x, a.y - at_a.y}});
    }
  if (!corners.empty()) add_quads(corners, lines_height, colour, opacity);
}

void Canvas::add_plate(const Box& box, const Colour& colour, double opacity) {
  Path corners = outline(box);
  corners.pop_back();
  add_quads(corners, plate_height, colour, opacity);
}

void Canvas::add_quads(const std::vector<Point2>& corners, double height, const Colour& colour, double opacity) {
  const vtkNew<vtkPolyData> shape = quads(corners, origin_, height);
  const vtkNew<vtkActor> actor = flat_actor(shape);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetOpacity(opacity);
  renderer_->AddActor(actor);
}

void Canvas::add_text(const PlacedText& requested) {
  PlacedText& text = texts_.emplace_back(requested);
  text.centre = {text.centre.x + origin_.x, text.centre.y + origin_.y};
  renderer_->AddActor2D(text_actor(text, theme_, window_ ? VTK_DISPLAY : VTK_WORLD));  // the caller's camera may move
}

double Canvas::add_text_from(Point2 left, const std::string& text, int font_size, double width) {
  const FittedText fitted = fit_text(text, font_size, width);
  PlacedText placed(fitted.text, left, fitted.font_size);
  placed.centre.x += placed.extent.width / 2;
  add_text(placed);
  return left.x + placed.extent.width;
}

void Canvas::add_colour_bar(const ColourBar& bar, const ColourScale& scale, double line_width) {
  // Draw the 256 colours as a patch of one beam whose range runs along the bar.
  vtkNew<vtkImageData> colours;
  colours->SetDimensions(256, 1, 1);
  colours->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<unsigned char*>(colours->GetScalarPointer());
  for (const Rgb& colour : scale.table) to = std::copy(colour.begin(), colour.end(), to);
  Path corners = outline(bar.bar);
  std::vector<Path> lines = bar.ticks;
  lines.push_back(corners);
  corners.pop_back();
  const double right = bar.lying ? 1 : 0, top = 1 - right;  // colours at these corners
  add_textured_strip(corners, {{0, 0.5}, {right, 0.5}, {1, 0.5}, {top, 0.5}}, colours);
  add_lines(lines, line_width, theme_.line, 1);
  for (const PlacedText& text : bar.texts) add_text(text);
}

std::string Canvas::png(const VtkMessages& messages) {
  window_->Render();
  return png_of_window(window_, messages, who_);
}

void save_picture(const PictureOptions& options, const char* who, const std::string& png_path,
                  const std::function<void(Canvas&)>& draw) {
  save_drawing(png_path, [&](const VtkMessages& messages) {
    Canvas canvas(options, who);
    draw(canvas);
    return canvas.png(messages);
  });
}

}  // namespace insonify
