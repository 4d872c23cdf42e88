// SPDX-License-Identifier: BSD-3-Clause
#include "tool/image/survey_heads_drawn.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/message.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

std::string folder_of_head(const std::string& run, const std::string& head) { return (fs::path(run) / head).string(); }

/// Takes the two sides of a side-scan off the heads, and returns their one picture; nothing if there are none.
std::optional<ImageOptions> both_sides(const ImageOptions& o, std::vector<std::string>& heads) {
  if (o.view != "waterfall" || !o.starboard.empty()) return {};
  const auto sides = o.head.empty() ? side_scan_heads(o.run) : std::nullopt;
  if (!sides) return {};
  ImageOptions both = o;
  both.run = folder_of_head(o.run, sides->port);
  both.starboard = folder_of_head(o.run, sides->starboard);
  std::erase_if(heads, [&](const std::string& head) { return head == sides->port || head == sides->starboard; });
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
           all.empty() ? "which is no survey of heads" : "one of " + shortened_list(all));
  }
  if (heads.empty() || view_of(o).of_survey) return {o};
  const std::size_t all_heads = heads.size();
  std::vector<ImageOptions> drawn;
  if (const auto both = both_sides(o, heads)) {
    drawn.push_back(*both);
    if (!heads.empty()) drawn.back().output = output_of_head(o.output, "sides");
  }
  for (const std::string& head : heads) {
    drawn.push_back(o);
    drawn.back().run = folder_of_head(o.run, head);
    if (all_heads > 1) drawn.back().output = output_of_head(o.output, head);
  }
  return drawn;
}

}  // namespace insonify::tool
