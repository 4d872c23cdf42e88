// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSmartPointer.h>

#include "view/off_screen_internal.hpp"
#include "viewer/show_viewer.hpp"
#include "viewer/viewer_controls_internal.hpp"
#include "viewer/viewer_explain.hpp"
#include "viewer/viewer_flat_panels_internal.hpp"
#include "viewer/viewer_layout.hpp"
#include "viewer/viewer_panel_internal.hpp"
#include "viewer/viewer_records_internal.hpp"
#include "viewer/viewer_scene_panel_internal.hpp"

namespace insonify {

enum class ViewerScreen { desktop, off_screen };

/// The viewer's window: draws a ViewerState with VTK and applies user actions to it.
class ViewerWindow {
 public:
  /// Keeps a reference: `data` must outlive it. Throws as show_viewer.
  ViewerWindow(const ViewerData& data, const ViewerOptions& options, ViewerScreen screen);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  const ViewerState& state() const { return state_; }
  const ViewerLayout& layout() const { return layout_; }
  const std::string& explanation() const { return explanation_; }
  /// Returns the centre of a sample's cell on the fan, in pixels of the window.
  Point2 pixel_of(PixelPosition position) const;
  /// Returns the centre of the button of a key; nothing if it is not shown.
  std::optional<Point2> pixel_of_button(const std::string& key) const;
  /// Returns the position in the window of a point of the world [m]; nothing without a 3-D panel.
  std::optional<Point2> pixel_of_point(const Eigen::Vector3d& world) const;
  bool finished() const { return finished_; }

  /// Apply user actions; each draws the new state.
  void press_key(const std::string& key);
  void click(Point2 position);
  void play(const ViewerEvent& event);

  /// Plays the events, then processes user input until the window is closed.
  void run(const std::vector<ViewerEvent>& events);
  void draw();
  void save_png(const std::string& path);
  vtkRenderWindowInteractor* interactor() { return interactor_; }

 private:
  void open(const ViewerOptions& options);
  void connect_style();
  void change(ViewerState next);
  void answer(const KeyAnswer& answer);
  void lay_out();
  void resized();
  void tick();
  void mouse(Point2 from, Point2 by);
  void guarded(const std::function<void()>& work);
  void say(const std::string& text) const;

  /// The functions of a panel: it draws from the state, and handles a click; null: nothing.
  struct Panel {
    void (ViewerWindow::*draw)(ViewerPanel& panel, const PictureOptions& options);
    void (ViewerWindow::*click)(Point2 position) = nullptr;
  };
  static const Panel panels_[std::size(viewer_panels)];  ///< in the order of viewer_panels

  Point2 on_panel(ViewerPanelName name, Point2 position) const;
  Point2 on_fan(Point2 position) const;
  PanelMotion motion_at(Point2 position) const;
  void click_fan(Point2 position);
  void click_scene(Point2 position);
  void click_ascan(Point2 position);
  void click_history(Point2 position);
  void select_on_waterfall(const Axes& axes, const BeamPage& page, Point2 position);
  void select(PixelPosition position, const Eigen::Vector2d& at);

  ViewerPanel& panel(ViewerPanelName name) { return shown_[static_cast<std::size_t>(name)]; }
  const ViewerPanel& panel(ViewerPanelName name) const { return shown_[static_cast<std::size_t>(name)]; }
  PictureOptions options_for(const Box& box) const;
  ViewerPanels parts() const;
  PixelPosition shown_position() const;
  void update_data();
  bool levels_stay() const;
  bool is_waterfall() const { return picture_ == ViewerPicture::waterfall || picture_ == ViewerPicture::sides; }
  PingHistory shown_history();
  void draw_picture(ViewerPanel& panel, const PictureOptions& options);
  void mark_picture(ViewerPanel& panel, const PictureOptions& options);
  void draw_scene(ViewerPanel& panel, const PictureOptions& options);
  void draw_beam(ViewerPanel& panel, const PictureOptions& options);
  void draw_history(ViewerPanel& panel, const PictureOptions& options);
  void draw_facts(ViewerPanel& panel, const PictureOptions& options);
  void draw_timeline(ViewerPanel& panel, const PictureOptions& options);
  void draw_status(ViewerPanel& panel, const PictureOptions& options);
  void draw_over();
  std::string status_text() const;

  const ViewerData& data_;
  ViewerScreen screen_;
  ViewerExtent extent_;
  std::function<void(const std::string&)> say_;
  VtkMessages messages_;
  ViewerState state_;
  std::optional<ViewerState> drawn_;  ///< none: everything must be drawn
  ViewerLayout layout_;
  bool finished_ = false;
  std::string explanation_, notice_;

  // Data selected by the state.
  std::optional<LevelImage> image_;
  std::optional<PixelFacts> facts_;
  std::optional<HeadView> head_view_;
  std::array<double, 2> max_db_ = {0, 0};  ///< top of the colour scale: raw, range compensated
  ViewerPicture picture_ = ViewerPicture::fan;
  SweepImage sweep_;                      ///< sweep in the first panel
  BeamPage picture_page_, history_page_;  ///< pages of the first panel, and of the waterfall below
  FanLayout fan_layout_;
  Axes ascan_axes_, picture_axes_, history_axes_;
  std::vector<PlacedButton> buttons_;  ///< in pixels of the window

  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor_;
  vtkSmartPointer<ViewerStyle> style_;
  std::array<ViewerPanel, std::size(viewer_panels)> shown_;  ///< one per ViewerPanelName
  ViewerPanel over_;                                         ///< help, or borders, on top of all panels
  std::unique_ptr<ViewerScene> scene_;
  std::unique_ptr<ViewerSliders> sliders_;
  double carried_ = 0, last_tick_ = 0;
  int timer_ = 0;
};

}  // namespace insonify
