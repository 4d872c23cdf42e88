// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <vector>

#include <hdf5_hl.h>

#include "store/cube_axes_internal.hpp"
#include "store/cube_layout_internal.hpp"

namespace insonify::hdf5 {
namespace {

bool is_there(hid_t file, const std::string& name) { return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0; }

/// Names the dimensions of one dataset, and attaches their scales unless the dataset is the scale itself.
void name_dimensions_of(const FileContext& context, hid_t file, const std::string& path,
                        const char* const* dimensions) {
  const Handle dataset = open_dataset(context, file, {path.c_str(), ""});
  for (unsigned d = 0; d < 4 && dimensions[d]; ++d) {
    context.checked(H5DSset_label(dataset, d, dimensions[d]), path);
    for (const CubeScale& scale : cube_scales)
      if (std::string(scale.dimension) == dimensions[d] && path != scale.name.path) {
        const Handle axis = open_dataset(context, file, scale.name);
        context.checked(H5DSattach_scale(dataset, axis, d), path);
      }
  }
}

}  // namespace

void name_dimensions(const FileContext& context, hid_t file) {
  for (const CubeScale& scale : cube_scales) {
    const Handle axis = open_dataset(context, file, scale.name);
    context.checked(H5DSset_scale(axis, scale.name.path + 1), scale.name.path);
  }
  for (const CubeDataset& dataset : cube_datasets)
    if (is_there(file, dataset.name.path)) name_dimensions_of(context, file, dataset.name.path, dataset.dimensions);
  for (const std::string& layer : names_in(context, file, layers_group))
    name_dimensions_of(context, file, std::string(layers_group) + "/" + layer, cube_datasets[0].dimensions);
}

bool names_dimensions(const std::string& attribute) {
  static const std::vector<std::string> made = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST",
                                                "DIMENSION_LABELS"};
  return std::find(made.begin(), made.end(), attribute) != made.end();
}

}  // namespace insonify::hdf5
