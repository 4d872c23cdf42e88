// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>

#include "view/placed_text.hpp"

namespace insonify {

/// Camera motion that the mouse controls in a panel.
enum class PanelMotion { none, slide, turn };

/// Mouse and keys of the viewer: drags rotate the scene and pan the fan, the wheel zooms both; clicks without motion
/// and all keys are passed to the window. VTK's own keys are disabled.
class ViewerStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static ViewerStyle* New();
  vtkTypeMacro(ViewerStyle, vtkInteractorStyleTrackballCamera);

  std::function<PanelMotion(Point2)> motion_at;
  std::function<void(Point2)> on_click;
  std::function<void(const std::string&)> on_key;
  std::function<void(bool)> on_moving;  ///< a drag has begun (true) or ended

  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnMiddleButtonDown() override;
  void OnMiddleButtonUp() override;
  void OnRightButtonDown() override;
  void OnRightButtonUp() override;
  void OnMouseMove() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  void OnKeyPress() override;
  void OnChar() override {}

 private:
  Point2 pointer() const;
  PanelMotion motion() const { return motion_at ? motion_at(pointer()) : PanelMotion::none; }

  void come_to_rest();

  Point2 pressed_;
  bool moving_ = false;
};

/// Returns the name of a key press for apply_key.
std::string key_name(const std::string& symbol, bool shift);

/// Sliders over everything else: gain and window of the levels, and the number of the ping if there are several.
class ViewerSliders {
 public:
  /// `moved` is called with gain and window [dB] and the ping (from 0) when the user moves a slider.
  ViewerSliders(vtkRenderWindow* window, vtkRenderWindowInteractor* interactor, std::size_t pings,
                std::function<void(double gain_db, double window_db, double ping)> moved);

  void lay_out(const Box& room, const Box& timeline, const int window_size[2], int font_size);
  void set(double gain_db, double window_db, double ping);

 private:
  void notify();

  vtkSmartPointer<vtkRenderer> renderer_;
  std::vector<vtkSmartPointer<vtkSliderWidget>> slider_;
  std::function<void(double, double, double)> moved_;
};

}  // namespace insonify
