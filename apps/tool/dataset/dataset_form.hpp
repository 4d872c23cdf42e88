// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "store/run_directory.hpp"

/// Lists of the images of a data set and of their boxes, as COCO and YOLO.
namespace insonify::tool {

/// One of the two forms of the images, polar or fan.
struct DatasetForm {
  std::string name;
  std::map<std::string, nlohmann::ordered_json> coco{};      ///< annotations of each split
  std::map<std::string, std::string> lists{};                ///< names of the images of each split, one a line
  std::vector<std::size_t> pixels{};                         ///< number of pixels of each class
  std::size_t boxes = 0, unboxed = 0;                        ///< unboxed: objects of too little contrast
  std::map<std::string, nlohmann::ordered_json> outlines{};  ///< polygons of the annotations of each split, in order
};
using FormPair = std::array<const DatasetForm*, 2>;

/// Returns a COCO file without images.
nlohmann::ordered_json empty_coco();
/// Returns the classes that a box of either form has, by their values in masks; YOLO numbers them in this order from 0.
std::vector<std::size_t> boxed_classes(const FormPair& forms);
/// Returns the number of boxes by class, split and form, of all splits that have images.
nlohmann::ordered_json boxes_by_class(const FormPair& forms, const std::vector<std::string>& classes);
/// Writes COCO with categories, the labels of YOLO, lists of images, and COCO with polygons if the form has outlines.
/// Throws Error(file).
///
/// boxed   of either form: what names classes does so by those that have boxes
void write_lists(const RunDirectory& directory, DatasetForm& form, const std::vector<std::string>& classes,
                 const std::vector<std::size_t>& boxed);

}  // namespace insonify::tool
