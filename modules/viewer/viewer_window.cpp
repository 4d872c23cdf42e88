// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkGenericRenderWindowInteractor.h>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "view/off_screen_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace insonify {
namespace {

constexpr int samples_per_pixel = 4;
constexpr unsigned long ticks_every_ms = 40;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void require_start(const ViewerState& start, const ViewerExtent& extent) {
  if (start.mode == ViewerMode::inspect) return;
  if (start.ping >= extent.pings)
    fail(ErrorKind::argument, viewer_caller, ": ping = ", start.ping, ", must be below ", extent.pings,
         ", the number of pings");
  if (start.selected && start.selected->beam >= extent.beams)
    fail(ErrorKind::argument, viewer_caller, ": beam = ", start.selected->beam, ", must be below ", extent.beams,
         ", the number of beams");
  if (start.selected && start.selected->bin >= extent.bins)
    fail(ErrorKind::argument, viewer_caller, ": bin = ", start.selected->bin, ", must be below ", extent.bins,
         ", the number of bins");
}

// Returns an unused file name.
std::string free_screenshot_name() {
  for (int i = 1;; ++i) {
    const std::string name = "insonify-view-" + std::to_string(i) + ".png";
    if (!path_exists(name)) return name;
  }
}

}  // namespace

ViewerWindow::ViewerWindow(const ViewerData& data, const ViewerOptions& options, ViewerScreen screen)
    : data_(data), screen_(screen), extent_(extent_of(data)), say_(options.say), state_(options.start) {
  require_viewable(data, state_.mode);
  require_start(state_, extent_);
  picture_ = picture_of(data);
  layout_ = lay_out_viewer(options.width, options.height, state_.mode, parts());
  if (state_.mode == ViewerMode::run) max_db_ = common_max_db(data);
  open(options);
  for (ViewerPanel& each : shown_) each = add_panel(window_);
  const ViewerPanel& fan = panel(ViewerPanelName::fan);
  fan.marks->SetActiveCamera(fan.content->GetActiveCamera());
  lay_out();
  if (ViewerScene::has_content(data))
    scene_ = std::make_unique<ViewerScene>(data, panel(ViewerPanelName::scene), state_,
                                           panel_options(layout_.scene_view, layout_.font_size));
  connect_style();
  if (state_.mode == ViewerMode::run)
    sliders_ = std::make_unique<ViewerSliders>(
        window_, interactor_, extent_.pings, [this](double gain_db, double window_db, double ping) {
          ViewerState next = state_;
          next.gain_db = gain_db;
          next.window_db = window_db;
          const auto requested = static_cast<std::size_t>(std::lround(std::max(0.0, ping)));
          if (requested != state_.ping) next.playing = false;
          next.ping = std::min(requested, extent_.pings - 1);
          guarded([&] { change(next); });
        });
  over_ = add_panel(window_);
  over_.content->SetLayer(1);
  over_.content->InteractiveOff();
  lay_out();
}

ViewerWindow::~ViewerWindow() {
  if (timer_ != 0) interactor_->DestroyTimer(timer_);
  sliders_.reset();
  interactor_->SetInteractorStyle(nullptr);
}

void ViewerWindow::open(const ViewerOptions& options) {
  if (screen_ == ViewerScreen::off_screen) {
    const auto window = vtkSmartPointer<EglWindow>::New();
    window->open(viewer_caller);
    window_ = window;
    interactor_ = vtkSmartPointer<vtkGenericRenderWindowInteractor>::New();
  } else {
    if (!has_display()) fail(ErrorKind::runtime, "no display: set DISPLAY, run under xvfb-run, or use insonify image");
    window_ = vtkSmartPointer<vtkRenderWindow>::New();
    interactor_ = vtkSmartPointer<vtkRenderWindowInteractor>::New();
  }
  // Multisampling smooths the edges of pictures; on a screen it would take most of the frame time of a software
  // renderer.
  window_->SetMultiSamples(screen_ == ViewerScreen::off_screen ? samples_per_pixel : 0);
  window_->SetDPI(72);  // one point of text is one pixel
  window_->SetSize(options.width, options.height);
  window_->SetNumberOfLayers(2);
  window_->SetWindowName(("insonify-view: " + data_.title).c_str());
  interactor_->SetRenderWindow(window_);
  window_->AddObserver(vtkCommand::WindowResizeEvent, this, &ViewerWindow::resized);
  interactor_->AddObserver(vtkCommand::TimerEvent, this, &ViewerWindow::tick);
}

void ViewerWindow::connect_style() {
  style_ = vtkSmartPointer<ViewerStyle>::New();
  style_->motion_at = [this](Point2 position) { return motion_at(position); };
  style_->on_click = [this](Point2 position) { guarded([&] { click(position); }); };
  style_->on_key = [this](const std::string& key) { guarded([&] { press_key(key); }); };
  style_->on_moving = [this](bool moving) {
    if (!scene_) return;
    scene_->set_moving(moving);
    if (!moving) draw();
  };
  interactor_->SetInteractorStyle(style_);
  if (scene_)
    panel(ViewerPanelName::scene)
        .content->AddObserver(vtkCommand::StartEvent, scene_.get(), &ViewerScene::follow_camera);
}

// Shows an error of a user action in the status line and keeps the window open.
void ViewerWindow::guarded(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    notice_ = error.what();
    say(notice_);
    drawn_.reset();
    draw();
  }
}

void ViewerWindow::say(const std::string& text) const {
  if (say_) say_(text);
}

ViewerPanels ViewerWindow::parts() const {
  return {ViewerScene::has_content(data_), !is_waterfall(), extent_.pings > 1, state_.show_colour_bars};
}

void ViewerWindow::lay_out() {
  const int* size = window_->GetSize();
  layout_ = lay_out_viewer(std::max(size[0], 800), std::max(size[1], 600), state_.mode, parts());
  for (const ViewerPanelBox& each : viewer_panels) place_panel(panel(each.value), layout_.*each.box, size);
  if (const Box& view = layout_.scene_view; view.width() > 0)
    panel(ViewerPanelName::scene)
        .content->SetViewport(view.left / size[0], view.bottom / size[1], view.right / size[0], view.top / size[1]);
  if (over_.content) place_panel(over_, {0, layout_.facts.right, 0, layout_.facts.top}, size);
  const double font = layout_.font_size;
  if (sliders_)
    sliders_->lay_out({layout_.facts.left + 2 * font, layout_.facts.right - 2 * font, layout_.facts.bottom + 0.5 * font,
                       layout_.facts.bottom + 12 * font},
                      layout_.timeline, size, layout_.font_size);
}

void ViewerWindow::resized() {
  const Box& box = layout_.status;
  const int* size = window_->GetSize();
  if (!drawn_ || (size[0] == box.right && size[1] == layout_.facts.top)) return;
  lay_out();
  drawn_.reset();
  guarded([this] { draw(); });
}

void ViewerWindow::press_key(const std::string& key) { answer(apply_key(state_, key, extent_)); }

void ViewerWindow::answer(const KeyAnswer& answer) {
  notice_.clear();
  change(answer.state);
  switch (answer.request) {
    case ViewerRequest::none:
      break;
    case ViewerRequest::screenshot: {
      const std::string name = free_screenshot_name();
      save_png(name);
      notice_ = "wrote " + name;
      say(name);
      break;
    }
    case ViewerRequest::print_pose:
      say(pose_option(vehicle_position(data_, state_.head)));
      break;
    case ViewerRequest::reset_cameras:
      if (scene_) scene_->reset_camera();
      drawn_.reset();
      draw();
      break;
    case ViewerRequest::quit:
      finished_ = true;
      if (screen_ == ViewerScreen::desktop) interactor_->TerminateApp();
      break;
  }
}

void ViewerWindow::change(ViewerState next) {
  const bool started = next.playing && !state_.playing;
  state_ = std::move(next);
  if (started) {
    carried_ = 0;
    last_tick_ = now();
    if (timer_ == 0 && screen_ == ViewerScreen::desktop) timer_ = interactor_->CreateRepeatingTimer(ticks_every_ms);
  }
  if (!state_.playing && timer_ != 0) {
    interactor_->DestroyTimer(timer_);
    timer_ = 0;
  }
  draw();
}

void ViewerWindow::tick() {
  if (!state_.playing) return;
  const double time = now();
  const ViewerState next = play_on(state_, time - last_tick_, extent_, carried_);
  last_tick_ = time;
  if (next.ping != state_.ping) guarded([&] { change(next); });
}

void ViewerWindow::play(const ViewerEvent& event) {
  const Box& box = box_of(layout_, event.panel);
  const Point2 from{box.left + event.from.x, box.bottom + event.from.y};
  switch (event.kind) {
    case ViewerEvent::Kind::click:
      return mouse(from, {});
    case ViewerEvent::Kind::drag:
      return mouse(from, event.by);
    case ViewerEvent::Kind::key:
      return press_key(event.text);
    case ViewerEvent::Kind::select: {
      ViewerState next = state_;
      next.selected = event.position;
      require_start(next, extent_);
      change(next);
      return say(explanation_);
    }
    case ViewerEvent::Kind::wait: {
      const double end = now() + event.seconds;
      while (now() < end && !finished_) {
        if (screen_ == ViewerScreen::desktop) interactor_->ProcessEvents();
        tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      return;
    }
    case ViewerEvent::Kind::screenshot:
      return save_png(event.text);
    case ViewerEvent::Kind::quit:
      finished_ = true;
  }
}

// Sends the events of the window system, so that style and sliders process them.
void ViewerWindow::mouse(Point2 from, Point2 by) {
  const auto move_to = [&](double part) {
    interactor_->SetEventInformation(static_cast<int>(std::lround(from.x + part * by.x)),
                                     static_cast<int>(std::lround(from.y + part * by.y)));
    interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
  };
  move_to(0);
  interactor_->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  if (by.x != 0 || by.y != 0)
    for (const double part : {0.25, 0.5, 0.75, 1.0}) move_to(part);
  interactor_->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
}

void ViewerWindow::run(const std::vector<ViewerEvent>& events) {
  interactor_->Initialize();
  draw();
  for (const ViewerEvent& event : events) {
    if (finished_) break;
    play(event);
  }
  if (!finished_ && screen_ == ViewerScreen::desktop) interactor_->Start();
}

}  // namespace insonify
