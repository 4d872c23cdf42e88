// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "files/pending_file.hpp"
#include "tool/dataset/dataset.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Readers resolve lists from the folder of the file itself, as long as there is no `path`, and demand train and val.
std::string yolo_yaml(const DatasetForm& form, const std::vector<std::string>& boxed) {
  std::string yaml = "train: train.txt\n";
  yaml += form.lists.contains("val") ? "val: val.txt\n" : "val: train.txt  # there is no image of val\n";
  if (form.lists.contains("test")) yaml += "test: test.txt\n";
  yaml += "names:\n";
  for (std::size_t k = 0; k < boxed.size(); ++k) yaml += fmt::format("  {}: {}\n", k, ordered_json(boxed[k]).dump());
  return yaml;
}

}  // namespace

ordered_json empty_coco() {
  return {{"info",
           {{"description", "simulated sonar images"}, {"contributor", std::string("insonify ") + INSONIFY_VERSION}}},
          {"licenses", ordered_json::array()},
          {"images", ordered_json::array()},
          {"annotations", ordered_json::array()},
          {"categories", ordered_json::array()}};
}

std::vector<std::size_t> boxed_classes(const FormPair& forms) {
  std::set<std::size_t> boxed;
  for (const DatasetForm* form : forms)
    for (const auto& [split, coco] : form->coco)
      for (const auto& annotation : coco["annotations"]) boxed.insert(annotation["category_id"].get<std::size_t>());
  return {boxed.begin(), boxed.end()};
}

ordered_json boxes_by_class(const FormPair& forms, const std::vector<std::string>& classes) {
  ordered_json boxes = ordered_json::object();
  for (const std::size_t k : boxed_classes(forms))
    for (const std::string& split : split_names)
      for (const DatasetForm* form : forms) {
        if (!form->coco.contains(split)) continue;
        std::size_t count = 0;
        for (const auto& a : form->coco.at(split)["annotations"]) count += a["category_id"].get<std::size_t>() == k;
        boxes[classes[k]][split][form->name] = count;
      }
  return boxes;
}

void write_lists(const RunDirectory& directory, DatasetForm& form, const std::vector<std::string>& classes,
                 const std::vector<std::size_t>& boxed) {
  std::vector<std::string> names;
  for (const std::size_t k : boxed) names.push_back(classes[k]);
  for (auto& [split, coco] : form.coco) {
    for (const std::size_t k : boxed)
      coco["categories"].push_back({{"id", k}, {"name", classes[k]}, {"supercategory", k == 1 ? "shadow" : "surface"}});
    std::map<std::size_t, std::string> labels;
    for (const auto& a : coco["annotations"]) {
      const auto number = std::find(boxed.begin(), boxed.end(), a["category_id"].get<std::size_t>()) - boxed.begin();
      const double height = a["segmentation"]["size"][0], width = a["segmentation"]["size"][1];
      const double left = a["bbox"][0], top = a["bbox"][1], wide = a["bbox"][2], tall = a["bbox"][3];
      labels[a["image_id"].get<std::size_t>()] +=
          fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", number, (left + 0.5 * wide) / width,
                      (top + 0.5 * tall) / height, wide / width, tall / height);
    }
    for (const auto& image : coco["images"])
      write_file(directory.file(form.name + "/labels/" +
                                fs::path(image["file_name"].get<std::string>()).stem().string() + ".txt"),
                 labels[image["id"].get<std::size_t>()]);
    write_file(directory.file(form.name + "/annotations/instances_" + split + ".json"), coco.dump() + "\n");
    write_file(directory.file(form.name + "/" + split + ".txt"), form.lists.at(split));
    if (!form.outlines.contains(split)) continue;
    for (std::size_t k = 0; k < coco["annotations"].size(); ++k)
      coco["annotations"][k]["segmentation"] = form.outlines[split][k];
    write_file(directory.file(form.name + "/annotations/polygons_" + split + ".json"), coco.dump() + "\n");
  }
  write_file(directory.file(form.name + "/data.yaml"), yolo_yaml(form, names));
}

}  // namespace insonify::tool
