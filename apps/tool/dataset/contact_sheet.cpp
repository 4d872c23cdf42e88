// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tool/dataset/dataset.hpp"
#include "view/grey_file.hpp"
#include "view/label_colours.hpp"

namespace insonify::tool {
namespace {

constexpr std::size_t most_images = 16;
constexpr int columns_of_sheet = 4, widest = 320, gap = 4;  // the latter two in pixels
constexpr std::uint32_t white = 0xffffff;

std::uint32_t colour_of(std::uint8_t category) {
  const auto [red, green, blue] = label_colour(category);
  return std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | blue;
}

/// The image, each pixel of which is the mean of step x step, in grey.
Grid<std::uint32_t> reduced(const Grid<std::uint8_t>& image, Eigen::Index step) {
  const Eigen::Index rows = std::max<Eigen::Index>(1, image.rows() / step), columns = image.cols() / step;
  Grid<std::uint32_t> small(rows, columns);
  for (Eigen::Index r = 0; r < rows; ++r)
    for (Eigen::Index c = 0; c < columns; ++c) {
      const Eigen::Index height = std::min(step, image.rows() - r * step);
      const auto block = image.block(r * step, c * step, height, step).cast<std::uint32_t>();
      small(r, c) = block.sum() / static_cast<std::uint32_t>(block.size()) * 0x010101;
    }
  return small;
}

/// Draws the sides of a box, a pixel wide.
void draw_box(const Annotation& object, Eigen::Index step, Grid<std::uint32_t>& image) {
  const auto row = [&](Eigen::Index at) { return std::clamp<Eigen::Index>(at / step, 0, image.rows() - 1); };
  const auto column = [&](Eigen::Index at) { return std::clamp<Eigen::Index>(at / step, 0, image.cols() - 1); };
  const Eigen::Index top = row(object.top), bottom = row(object.top + object.height - 1);
  const Eigen::Index left = column(object.left), right = column(object.left + object.width - 1);
  const std::uint32_t colour = colour_of(object.category);
  for (const Eigen::Index r : {top, bottom}) image.row(r).segment(left, right - left + 1).setConstant(colour);
  for (const Eigen::Index c : {left, right}) image.col(c).segment(top, bottom - top + 1).setConstant(colour);
}

}  // namespace

void ContactSheet::add(const Grid<std::uint8_t>& image, const std::vector<Annotation>& objects) {
  if (added_++ % every_ != 0) return;
  const Eigen::Index step = (image.cols() + widest - 1) / widest;
  Grid<std::uint32_t> small = reduced(image, step);
  for (const Annotation& object : objects) draw_box(object, step, small);
  kept_.push_back(std::move(small));
  if (kept_.size() <= most_images) return;
  for (std::size_t k = 0; 2 * k < kept_.size(); ++k) kept_[k] = std::move(kept_[2 * k]);
  kept_.resize((kept_.size() + 1) / 2);
  every_ *= 2;
}

void ContactSheet::save(const std::string& path) const {
  if (kept_.empty()) return;
  Eigen::Index height = 0, width = 0;
  for (const auto& image : kept_) height = std::max(height, image.rows()), width = std::max(width, image.cols());
  const auto count = static_cast<Eigen::Index>(kept_.size());
  const Eigen::Index across = std::min<Eigen::Index>(columns_of_sheet, count), down = (count + across - 1) / across;
  Grid<std::uint32_t> sheet =
      Grid<std::uint32_t>::Constant(down * (height + gap) - gap, across * (width + gap) - gap, white);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& image = kept_[static_cast<std::size_t>(k)];
    sheet.block(k / across * (height + gap), k % across * (width + gap), image.rows(), image.cols()) = image;
  }
  save_rgb_png(path, sheet);
}

}  // namespace insonify::tool
