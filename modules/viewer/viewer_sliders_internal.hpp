#pragma once
#include <array>
#include <functional>

#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>

#include "view/placed_text.hpp"

namespace insonify {

/// Two sliders, gain and window of the levels, over everything else.
class ViewerSliders {
 public:
  /// `moved` is called with gain and window [dB] when the user moves a slider.
  ViewerSliders(vtkRenderWindow* window, vtkRenderWindowInteractor* interactor,
                std::function<void(double gain_db, double window_db)> moved);

  void place(const Box& room, const int window_size[2], int font_size);
  void set(double gain_db, double window_db);

 private:
  void notify();

  vtkSmartPointer<vtkRenderer> renderer_;
  std::array<vtkSmartPointer<vtkSliderWidget>, 2> slider_;
  std::function<void(double, double)> moved_;
};

}  // namespace insonify
