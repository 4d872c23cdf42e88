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

/// Returns one picture of two heads if they are the sides of a side-scan; nothing if not.
std::optional<ImageOptions> both_sides(const ImageOptions& o, const std::vector<std::string>& heads) {
  constexpr double athwart = 0.5;
  if (o.view != "waterfall" || !o.starboard.empty() || heads.size() != 2) return {};
  const double first = looks_to_port(o.run, heads[0]), second = looks_to_port(o.run, heads[1]);
  if (std::min(std::abs(first), std::abs(second)) < athwart || (first > 0) == (second > 0)) return {};
  ImageOptions both = o;
  both.run = folder_of_head(o.run, heads[first > 0 ? 0 : 1]);
  both.starboard = folder_of_head(o.run, heads[first > 0 ? 1 : 0]);
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
  if (const auto both = both_sides(o, heads)) return {*both};
  std::vector<ImageOptions> drawn;
  for (const std::string& head : heads) {
    ImageOptions of_head = o;
    of_head.run = folder_of_head(o.run, head);
    const fs::path output = o.output;
    if (heads.size() > 1)
      of_head.output =
          (output.parent_path() / (output.stem().string() + "-" + head + output.extension().string())).string();
    drawn.push_back(of_head);
  }
  return drawn;
}

}  // namespace insonify::tool
