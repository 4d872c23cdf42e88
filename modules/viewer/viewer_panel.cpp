#include <algorithm>
#include <sstream>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "view/text.hpp"
#include "viewer/viewer_panel_internal.hpp"

namespace insonify {

ViewerPanel add_panel(vtkRenderWindow* window) {
  ViewerPanel panel{vtkSmartPointer<vtkRenderer>::New(), vtkSmartPointer<vtkRenderer>::New()};
  panel.marks->SetLayer(1);
  panel.marks->InteractiveOff();
  window->AddRenderer(panel.content);
  window->AddRenderer(panel.marks);
  return panel;
}

void place_panel(ViewerPanel& panel, const Box& box, const int window_size[2]) {
  const bool shown = box.width() > 0 && box.height() > 0;
  for (vtkRenderer* renderer : {panel.content.Get(), panel.marks.Get()}) {
    renderer->SetDraw(shown);
    if (shown)
      renderer->SetViewport(box.left / window_size[0], box.bottom / window_size[1], box.right / window_size[0],
                            box.top / window_size[1]);
  }
}

PictureOptions panel_options(const Box& box, int font_size) {
  PictureOptions options;
  options.width = static_cast<int>(box.width());
  options.height = static_cast<int>(box.height());
  options.font_size = font_size;
  options.dark = true;
  return options;
}

Canvas fresh_canvas(vtkRenderer* renderer, const PictureOptions& options, bool keep_camera) {
  renderer->RemoveAllViewProps();
  vtkNew<vtkCamera> before;
  before->DeepCopy(renderer->GetActiveCamera());
  Canvas canvas(renderer, options, "show_viewer");
  if (keep_camera) renderer->GetActiveCamera()->DeepCopy(before);
  return canvas;
}

// The plate lies below the canvas's own heights, and so behind everything else in any order of drawing.
void add_plate(Canvas& canvas, const Box& box, const Colour& colour, double opacity) {
  constexpr double height = -1;
  vtkNew<vtkPoints> points;
  for (const auto& [x, y] :
       {std::pair{box.left, box.bottom}, {box.right, box.bottom}, {box.right, box.top}, {box.left, box.top}})
    points->InsertNextPoint(x, y, height);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetOpacity(opacity);
  canvas.renderer()->AddActor(actor);
}

void add_text_lines(Canvas& canvas, const std::string& text, const Box& box, int font_size) {
  const double line = 1.45 * font_size;
  double middle = box.top - line / 2;
  std::istringstream lines(text);
  for (std::string words; std::getline(lines, words) && middle - line / 2 >= box.bottom; middle -= line) {
    if (words.empty()) continue;
    const double indent = static_cast<double>(words.find_first_not_of(' ')) * 0.5 * font_size;
    const FittedText fitted =
        fit_text(words.substr(std::min(words.find_first_not_of(' '), words.size())), font_size, box.width() - indent);
    const double width = text_size(fitted.text, fitted.font_size).width;
    canvas.add_text({fitted.text, {box.left + indent + width / 2, middle}, fitted.font_size});
  }
}

}  // namespace insonify
