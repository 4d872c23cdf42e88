#pragma once
#include <functional>
#include <string>

#include <vtkInteractorStyleTrackballCamera.h>

#include "viewer/viewer_layout.hpp"

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

/// The name of a key press for apply_key.
std::string key_name(const std::string& symbol, bool shift);

}  // namespace insonify
