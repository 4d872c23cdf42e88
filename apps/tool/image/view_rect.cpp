// SPDX-License-Identifier: BSD-3-Clause
#include "tool/image/image.hpp"

namespace insonify::tool {

ViewSpec rect_view() {
  return {.name = "rect",
          .shows = "beams against range",
          .options = {annotate_option, animate_option},
          .draw = [](const PictureRequest& job) { show_rect(levels_of(job), job.picture, job.path); },
          .max_db = max_db_of_image,
          .of_levels = true};
}

}  // namespace insonify::tool
