// SPDX-License-Identifier: BSD-3-Clause
#include "tool/image/survey_heads_drawn.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/text.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

std::string folder_of_head(const std::string& run, const std::string& head) { return (fs::path(run) / head).string(); }

/// How far a head looks to port: the part of its axis along that of the ship; 0 if the run does not say.
double looks_to_port(const std::string& run, const std::string& head) {
  const std::optional<Pose> mounting = find_run_pings(run, head).vehicle_from_head;
  return mounting ? mounting->linear()(1, 0) : 0;
}

/// The picture of a file, with a word in its name.
std::string named(const std::string& output, const std::string& word) {
  const fs::path path = output;
  return (path.parent_path() / (path.stem().string() + "-" + word + path.extension().string())).string();
}

/// Takes the two sides of a side-scan off the heads, and returns their one picture; nothing if there are none.
std::optional<ImageOptions> both_sides(const ImageOptions& o, std::vector<std::string>& heads) {
  constexpr double athwart = 0.5;
  if (o.view != "waterfall" || !o.starboard.empty()) return {};
  std::vector<std::string> port, starboard;
  for (const std::string& head : heads)
    if (const double looks = looks_to_port(o.run, head); std::abs(looks) > athwart)
      (looks > 0 ? port : starboard).push_back(head);
  if (port.size() != 1 || starboard.size() != 1) return {};
  ImageOptions both = o;
  both.run = folder_of_head(o.run, port.front());
  both.starboard = folder_of_head(o.run, starboard.front());
  std::erase_if(heads, [&](const std::string& head) { return head == port.front() || head == starboard.front(); });
  return both;
}

}  // namespace

std::vector<ImageOptions> drawn_heads(const ImageOptions& o) {
  const std::vector<std::string> all = head_names(o.run);
  std::vector<std::string> heads = all;
  if (!o.head.empty()) {
    std::erase_if(heads, [&](const std::string& head) { return head != o.head; });
    if (heads.empty())
      fail(ErrorKind::argument, "--head = '", o.head, "' must name a head of ", o.run, ", ",
           all.empty() ? "which is no survey of heads" : "one of " + joined(all));
  }
  if (heads.empty() || view_of(o).of_survey) return {o};
  const std::size_t all_heads = heads.size();
  std::vector<ImageOptions> drawn;
  if (const auto both = both_sides(o, heads)) {
    drawn.push_back(*both);
    if (!heads.empty()) drawn.back().output = named(o.output, "sides");
  }
  for (const std::string& head : heads) {
    drawn.push_back(o);
    drawn.back().run = folder_of_head(o.run, head);
    if (all_heads > 1) drawn.back().output = named(o.output, head);
  }
  return drawn;
}

}  // namespace insonify::tool
