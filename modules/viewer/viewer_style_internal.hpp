#pragma once
#include <functional>
#include <string>

#include <vtkInteractorStyleTrackballCamera.h>

#include "viewer/viewer_layout.hpp"

namespace insonify {

/// What a mouse may do to a panel's camera.
enum class PanelMotion { none, slide, turn };

/// Mouse and keys of the viewer: drags turn the scene and slide the fan, wheels zoom both; a click that does not move
/// and every key go to the window. VTK's own keys are off.
class ViewerStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static ViewerStyle* New();
  vtkTypeMacro(ViewerStyle, vtkInteractorStyleTrackballCamera);

  std::function<PanelMotion(Point2)> motion_at;
  std::function<void(Point2)> on_click;
  std::function<void(const std::string&)> on_key;
  std::function<void(bool)> on_moving;  ///< a drag has begun, or ended

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

/// The name under which a key press reaches apply_key.
std::string key_name(const std::string& symbol, bool shift);

}  // namespace insonify
