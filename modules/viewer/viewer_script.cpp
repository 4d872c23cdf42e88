// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_script.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/text.hpp"

namespace insonify {
namespace {

[[noreturn]] void refuse(const std::string& event, const std::string& rule) {
  fail(ErrorKind::argument, "events: '", event, "': ", rule);
}

double number_in(std::istringstream& words, const std::string& event, const char* meaning) {
  double value = 0;
  if (!(words >> value) || !std::isfinite(value)) refuse(event, std::string("needs a number, ") + meaning);
  return value;
}

std::size_t index_in(std::istringstream& words, const std::string& event, const char* meaning) {
  const double value = number_in(words, event, meaning);
  if (value < 0 || value > 1e9 || value != std::floor(value))
    refuse(event, std::string(meaning) + " must be 0, 1, ...");
  return static_cast<std::size_t>(value);
}

std::string word_in(std::istringstream& words, const std::string& event, const char* meaning) {
  std::string word;
  if (!(words >> word)) refuse(event, std::string("needs ") + meaning);
  return word;
}

ViewerPanelName panel_in(std::istringstream& words, const std::string& event) {
  const std::string names = joined(viewer_panels, ", ", &ViewerPanelBox::name);
  const std::string name = word_in(words, event, ("a panel: " + names).c_str());
  if (const ViewerPanelName* panel = find_named(viewer_panels, name)) return *panel;
  refuse(event, "no panel is called '" + name + "'; there are " + names);
}

Point2 point_in(std::istringstream& words, const std::string& event) {
  const double x = number_in(words, event, "pixels from the left");
  return {x, number_in(words, event, "pixels from below")};
}

ViewerEvent parse_event(const std::string& text) {
  std::istringstream words(text);
  const std::string verb = word_in(words, text, "a verb");
  ViewerEvent event;
  if (verb == "click" || verb == "drag") {
    event.kind = verb == "click" ? ViewerEvent::Kind::click : ViewerEvent::Kind::drag;
    event.panel = panel_in(words, text);
    event.from = point_in(words, text);
    if (verb == "drag") event.by = point_in(words, text);
  } else if (verb == "key") {
    event.kind = ViewerEvent::Kind::key;
    event.text = word_in(words, text, "the name of a key, e.g. m, Left, shift+Up");
  } else if (verb == "select") {
    event.kind = ViewerEvent::Kind::select;
    event.position.beam = index_in(words, text, "the beam");
    event.position.bin = index_in(words, text, "the bin");
  } else if (verb == "wait") {
    event.kind = ViewerEvent::Kind::wait;
    event.seconds = number_in(words, text, "seconds");
    if (event.seconds < 0 || event.seconds > 3600) refuse(text, "must be 0 to 3600 seconds");
  } else if (verb == "screenshot") {
    event.kind = ViewerEvent::Kind::screenshot;
    event.text = word_in(words, text, "a file");
  } else if (verb != "quit") {
    refuse(text, "no event is called '" + verb + "'; there are click, drag, key, select, wait, screenshot, quit");
  }
  if (std::string more; words >> more) refuse(text, "'" + more + "' is too much");
  return event;
}

}  // namespace

std::vector<ViewerEvent> parse_viewer_script(const std::string& text) {
  std::vector<ViewerEvent> events;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream parts(line.substr(0, line.find('#')));
    for (std::string part; std::getline(parts, part, ';');)
      if (part.find_first_not_of(" \t\r") != std::string::npos) events.push_back(parse_event(part));
  }
  return events;
}

}  // namespace insonify
