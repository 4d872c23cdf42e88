// SPDX-License-Identifier: BSD-3-Clause
#include "tool/image/image.hpp"

namespace insonify::tool {

ViewSpec fan_view() {
  return {.name = "fan",
          .shows = "beams and ranges to scale",
          .options = {annotate_option, animate_option},
          .draw = [](const PictureRequest& job) { show_fan(levels_of(job), job.picture, job.path); },
          .max_db = max_db_of_image,
          .of_levels = true,
          .of_bearings = true};
}

}  // namespace insonify::tool
