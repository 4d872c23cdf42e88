// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/grid.hpp"
#include "formats/label_map.hpp"
#include "returns/label_objects.hpp"
#include "returns/picture_grid.hpp"
#include "returns/quantise.hpp"
#include "store/cube.hpp"
#include "store/mission_file.hpp"
#include "store/run_directory.hpp"
#include "survey/randomise.hpp"
#include "tool/command/option_list.hpp"
#include "tool/dataset/labelled_image.hpp"

namespace insonify::tool {

/// Options of `dataset`.
struct DatasetOptions {
  CommonOptions common;
  std::vector<std::string> runs;
  std::string output, window;
  double share = least_label_share;  ///< least share of a pixel's energy that gives its class
  std::string min_level;             ///< [dB] or black, below which surfaces have no class; empty: none
  int least_pixels = 20;             ///< least number of pixels of an object
  double min_contrast = 3;           ///< [dB] of an object to what is around it, for a box
  int columns = 512;                 ///< width of fan pictures [pixels]
  double tvg = 40;                   ///< [dB per decade of range]
  bool raw = false;                  ///< no TVG
  std::vector<std::string> stuff;    ///< classes that are in masks alone
  std::vector<std::string> things;   ///< classes that have boxes although they have none by default: shadow
  bool polygons = false;             ///< outlines beside the masks of COCO
  std::string row;                   ///< row of beams of heads with several: a number, all, or empty: the middle one
  std::string split = "80:10:10", split_by = "scene";
  bool force = false;
};

/// An image of a data set.
struct DatasetImage {
  std::string name, split;           ///< split: train, val or test
  std::optional<std::size_t> row{};  ///< row of beams, if the head has several
};

// Runs that `dataset` reads.

/// Cubes of one head of a run or survey, read one after the other.
struct DatasetSource {
  std::string run, head;       ///< head: of a survey; else empty
  std::size_t run_index = 0;   ///< in the list of runs
  std::size_t head_index = 0;  ///< in the mission
  std::vector<std::string> cubes;
  std::vector<TrackPoint> track;     ///< all pings, in the order of the cubes
  std::string scene;                 ///< path, or empty: unknown
  std::string scene_digest;          ///< digest of the scene's file; of a run without its scene that of the run's name
  std::vector<std::string> split{};  ///< train, val or test, of each ping
  std::vector<std::set<std::string>> shows{};  ///< classes that have boxes, of each ping; empty: unknown
  std::string draw_key;        ///< key of a run that is no survey: equal for pings of one draw of one scene
  Randomisation randomise{};   ///< spread of its mission; of another run none
  std::uint64_t seed = 1;      ///< seed of that spread
  SceneInstances instances{};  ///< if the scene's cloud has a field `instance`
  std::string note{};          ///< on files of the scene that are gone; empty: none
};

/// The heads of runs, surveys and cubes. Throws Error(file) for one that is not there, Error(content) for a survey that
/// is not whole.
std::vector<DatasetSource> dataset_sources(const std::vector<std::string>& runs);

/// Calls `body` with every ping of a source and its position in the track, one in memory at a time. Throws
/// Error(content) for pings without labels.
void for_each_labelled_ping(const DatasetSource& source,
                            const std::function<void(const Cube&, const Ping&, std::size_t)>& body);

// Which images train, which validate, which test.

/// The names of the parts of a data set, in this order.
inline const std::vector<std::string> split_names{"train", "val", "test"};

/// A kind of unit that stays together in one part of a data set.
struct SplitUnit {
  const char* name;    ///< word of --split-by
  const char* plural;  ///< in messages
  const char* means;   ///< in --help and in the card
};
/// All of them, the default first.
const std::vector<SplitUnit>& split_units();

/// Gives every ping of the sources to train, val or test: `unit` names what stays together, `shares` are those of units
/// (of regions: of the pings of each run). Each share above 0 gets a unit as long as there are units: train first, then
/// val. Scenes go by their digests, legs in the order of runs and missions, a region is one stretch of a run's track
/// for each part, the same for all its heads, and pings are drawn, the same ones each time. Scenes, draws and pings are
/// given so that each class that DatasetSource::shows lists is in the parts by their shares, as well as it goes. A
/// run that is no survey is of the draw in its run.toml. Throws as load_mission.
void split_pings(std::vector<DatasetSource>& sources, const std::string& unit, const std::vector<double>& shares);

/// Counts images by part, and those that may show what training shows.
class SplitTally {
 public:
  /// Notes an image of a part of the data set: where the head was and how far it heard.
  void add(const std::string& split, const std::string& scene_digest, const Eigen::Vector3d& position,
           double max_range);

  /// Images of each part that has one.
  std::map<std::string, std::size_t> images() const;
  /// Counts images of a part that were taken of the same scene within their farthest range of an image of train.
  std::size_t near_train(const std::string& split) const;
  /// Sentences about parts without an image, and about those that share places with train.
  std::vector<std::string> notes(const std::string& unit, const std::string& split_option,
                                 const std::vector<double>& shares) const;

 private:
  struct Image {
    std::string scene;
    Eigen::Vector3d position;
    double max_range;
  };
  std::map<std::string, std::vector<Image>> images_;  ///< images of each part
};

// Lists of the images of a data set and of their boxes, as COCO and YOLO.

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

/// The facts that the card of a data set states.
struct DatasetCard {
  const DatasetOptions& options;
  const std::vector<std::string>& classes;  ///< names of the masks' values
  GreyWindow window;
  const DatasetForm &polar, &fan;
  const SplitTally& tally;
  std::size_t images;
  const std::string& sonars;  ///< a line of the card for each
};

/// Returns whether objects of a class have boxes.
bool is_thing(const DatasetOptions& options, const std::vector<std::string>& classes, std::size_t category);

/// Returns the README.md of a data set.
std::string dataset_card(const DatasetCard& of);

/// An image and the ping that it shows.
struct ImageOf {
  const DatasetSource& source;
  const Cube& cube;
  const Ping& ping;
  const DatasetImage& image;
};

/// Returns a line of meta.jsonl on an image as far as its objects: run, pose, sonar, water, seed, mapping, parts.
///
/// polar_pixels   of each class, in the polar image
nlohmann::ordered_json image_meta(const ImageOf& of, const DatasetOptions& options, GreyWindow window,
                                  const std::vector<std::size_t>& polar_pixels);

/// Some images of a data set with the boxes of their objects, on one page: 16 at most, evenly from all that are added.
class ContactSheet {
 public:
  /// Adds an image, rows from the top, with its objects.
  void add(const Grid<std::uint8_t>& image, const std::vector<Annotation>& objects);
  /// Writes the page as a PNG, four images in a row, boxes in the colours of their classes (label_colour). Writes
  /// nothing if no image was added. Throws Error(file) if it cannot write.
  void save(const std::string& path) const;

 private:
  std::vector<Grid<std::uint32_t>> kept_;  ///< pixels of kept images, as red x 65536 + green x 256 + blue
  std::size_t added_ = 0, every_ = 1;      ///< one in so many is kept
};

/// Writes images, masks, boxes and lists of a data set into a folder.
class DatasetWriter {
 public:
  /// `classes` are the names of the masks' values: nothing, shadow, then materials.
  DatasetWriter(const RunDirectory& directory, const DatasetOptions& options, std::vector<std::string> classes,
                GreyWindow window);

  /// Adds a ping of one row of beams.
  void add(const DatasetSource& source, const Cube& cube, const Ping& ping, const DatasetImage& image);
  /// Writes what lists all images. Throws Error(content) if no pixel of any image shows a surface.
  void finish();

  std::size_t images() const { return images_; }
  const DatasetForm& polar() const { return polar_; }
  const DatasetForm& fan() const { return fan_; }
  const SplitTally& tally() const { return tally_; }
  /// Boxes by class, part and form, of all parts that have images.
  nlohmann::ordered_json boxes_by_class() const { return tool::boxes_by_class({&polar_, &fan_}, classes_); }

 private:
  /// How a form shows a ping.
  struct FormOf {
    PictureOf picture;
    LabelMap map;
    Grid<float> level_db;
    const ObjectsOf& objects;
  };
  /// Writes one image; returns the contrasts of its objects, and what has no box for it.
  struct Contrasts {
    std::map<std::uint16_t, std::optional<double>> of{};
    nlohmann::ordered_json unboxed = nlohmann::ordered_json::array();
  };
  Contrasts add_form(DatasetForm& form, const DatasetImage& image, const FormOf& of);
  nlohmann::ordered_json annotation_of(const Annotation& a, const FormOf& of, std::optional<double> contrast);
  /// Keeps what card and manifest say of the sources of all images.
  void note_source(const DatasetSource& source, const Cube& cube, const Ping& ping);
  const FanRaster& raster_of(const Ping& ping);

  const RunDirectory& directory_;
  const DatasetOptions& options_;
  std::vector<std::string> classes_;
  GreyWindow window_;
  std::size_t images_ = 0, annotations_ = 0;
  DatasetForm polar_{"polar"}, fan_{"fan"};
  std::string meta_, sonars_;
  ContactSheet sheet_;                      ///< sheet of fan images
  std::vector<Annotation> boxed_of_sheet_;  ///< annotations of the image that was added last
  nlohmann::ordered_json renumbered_ = nlohmann::ordered_json::object();  ///< ids given to instances, by scene
  std::map<std::string, FanRaster> rasters_;
  SplitTally tally_;
};

/// Levels of a ping as the images show them: with the options' TVG.
Grid<float> dataset_levels(const Ping& ping, const DatasetOptions& options);

}  // namespace insonify::tool
