// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "hdf/dataset_name_internal.hpp"

namespace insonify {

/// Version of the layout of cube.h5, raised when readers of the previous one would fail.
constexpr std::int64_t cube_schema = 1;

constexpr DatasetName pressure_name{"/pressure", "Pa", "sound pressure of the received signal, complex amplitude"};
/// Cubes of display cells have this dataset in place of /pressure and for their layers: 16-bit integers, 0.01 dB each.
constexpr DatasetName level_name{"/level", "dB re 1 uPa",
                                 "mean level over a display cell; the number times scale_factor; -32768: no sound"};
constexpr const char* scale_factor_attribute = "scale_factor";
constexpr double level_step = 0.01;  // [dB]
constexpr std::int16_t no_level = -32768;
/// Root attribute that marks a cube of display cells.
constexpr const char* display_cells_attribute = "display_cells";
constexpr const char* display_cells_text = "mean intensity over the area of each cell, without phase";
/// Attribute of pressures: the relation of their numbers to levels.
constexpr const char* convention_attribute = "convention";
constexpr const char* pressure_convention =
    "complex amplitude of the analytic signal at baseband; rms = abs / sqrt(2); "
    "level [dB re 1 uPa] = 20 log10(abs / sqrt(2) / 1e-6)";
/// Group of the layers, each a dataset like /pressure; absent without layers.
constexpr const char* layers_group = "/layers";
/// Optional maps of the extent of /pressure, one real number per cell.
constexpr DatasetName intensity_name{"/intensity", "Pa^2",
                                     "mean over the looks of the squared magnitude of the amplitude; level [dB re 1 "
                                     "uPa] = 10 log10(intensity / 2 / 1e-12)"};
constexpr DatasetName unknown_name{"/unknown", "", "1 where surface may be missing because the scan has a hole"};
constexpr DatasetName split_phase_name{"/split_phase", "rad",
                                       "phase of the port half of the array against its starboard half"};
constexpr DatasetName label_material_name{"/label_material", "",
                                          "material, index into label_names; 65535: nothing, 65534: shadow"};
constexpr DatasetName label_id_name{"/label_id", "", "id of the strongest surfel in the scene; 4294967295: none"};
constexpr DatasetName label_share_name{"/label_share", "", "share of the energy that is of the material, 0 to 1"};
/// Datasets of display cells: the elevation of the strongest surfel, and the second label.
constexpr DatasetName label_elevation_name{"/label_elevation", "rad",
                                           "of the strongest surfel above the x-y plane of the head; 0: none"};
constexpr DatasetName label_second_name{"/label_second", "",
                                        "material with the most energy among the others; 65535: none"};
constexpr DatasetName label_second_share_name{"/label_second_share", "",
                                              "share of the energy that is of this second material, 0 to 1"};
/// Root attribute: names of the materials of /label_material, one a line.
constexpr const char* label_names_attribute = "label_names";
/// Datasets of scenes of parts: the part of the strongest surfel, and how the head sees each part.
constexpr DatasetName label_part_name{"/label_part", "", "part of the scene, index into part_names; 65535: none"};
constexpr DatasetName part_views_name{
    "/part_views", "",
    "of each part in each ping: world_from_part (three rows of four, row-major, place in m), share of it that the head "
    "sees, least and most azimuth [rad], elevation [rad], range [m], azimuth of the beam that hears it [rad] and "
    "places ahead and to port in a picture in true geometry [m] of all of it, scale of its file, size along the axes "
    "of its file [m]; NaN: not in view, or none"};
/// Root attributes: names of the parts, and their labels, which may be empty, one a line.
constexpr const char *part_names_attribute = "part_names", *part_labels_attribute = "part_labels";
/// Root attribute: notes of the pings, one a line (as_lines); absent without notes.
constexpr const char* notes_attribute = "notes";
/// Root attribute: significant bits of the pressures, if they are rounded.
constexpr const char* keep_bits_attribute = "keep_bits";
/// Root attribute that marks a cube whose pressures are roots of expected intensities.
constexpr const char* expected_level_attribute = "expected_level";
constexpr DatasetName range_name{"/range", "m", "middle of the bins, one way"};
constexpr DatasetName azimuth_name{"/azimuth", "rad", "of the beams about the z axis of the head, positive to port"};
constexpr DatasetName elevation_name{"/elevation", "rad", "of the beams above the x-y plane of the head, positive up"};
constexpr DatasetName pose_name{"/pose", "1, 1, 1, m",
                                "world_from_head, row-major: columns 0 to 2 are the axes of the head (forward, port, "
                                "up) in the world, without unit, column 3 its place [m]"};
constexpr DatasetName time_name{"/time", "s", "of transmission, from start_utc or the begin of the run"};
constexpr DatasetName ping_name{"/ping", "", "number of the ping"};
/// Datasets of the water of each ping, if it differs; they replace the root attributes of these names.
constexpr DatasetName sound_speed_name{"/sound_speed", "m/s", "of the water at the head of each ping"};
constexpr DatasetName absorption_name{"/absorption_db_per_m", "dB/m",
                                      "of the water at the head of each ping, one way, at the centre frequency"};
/// Datasets of the motion of the head, if it moves during any ping.
constexpr DatasetName velocity_name{"/velocity", "m/s", "of the head in the world while it listens, x, y, z"};
constexpr DatasetName turn_rate_name{"/turn_rate", "rad/s",
                                     "rotation vector of the head in the world per second, x, y, z"};
/// Datasets of a scanning head: time and pose of every beam, and the head's own turn.
constexpr DatasetName beam_time_name{"/beam_time", "s", "of transmission, of every beam"};
constexpr DatasetName beam_pose_name{"/beam_pose", "1, 1, 1, m", "of every beam, as pose"};
constexpr DatasetName scan_angle_name{"/scan_angle", "rad",
                                      "turn of the head about its z axis, positive to port; part of the pose"};
constexpr DatasetName sweep_name{"/sweep", "", "number of the sweep"};

/// Root attributes of cubes of a survey: name of the head, time 0, place of the world's origin and heading of its x
/// axis.
constexpr const char* head_attribute = "head";
constexpr const char* start_utc_attribute = "start_utc";
constexpr const char* anchor_latitude_attribute = "anchor_latitude_deg";
constexpr const char* anchor_longitude_attribute = "anchor_longitude_deg";
constexpr const char* anchor_heading_attribute = "anchor_heading_deg";

/// All datasets that a cube can have, and the kinds of their dimensions: "ping", "beam", "bin".
struct CubeDataset {
  DatasetName name;
  const char* dimensions[4];  ///< null: this and later dimensions have no name
};
constexpr CubeDataset cube_datasets[] = {{pressure_name, {"ping", "beam", "bin"}},
                                         {level_name, {"ping", "beam", "bin"}},
                                         {intensity_name, {"ping", "beam", "bin"}},
                                         {unknown_name, {"ping", "beam", "bin"}},
                                         {split_phase_name, {"ping", "beam", "bin"}},
                                         {label_material_name, {"ping", "beam", "bin"}},
                                         {label_id_name, {"ping", "beam", "bin"}},
                                         {label_share_name, {"ping", "beam", "bin"}},
                                         {label_part_name, {"ping", "beam", "bin"}},
                                         {label_elevation_name, {"ping", "beam", "bin"}},
                                         {label_second_name, {"ping", "beam", "bin"}},
                                         {label_second_share_name, {"ping", "beam", "bin"}},
                                         {part_views_name, {"ping"}},
                                         {range_name, {"bin"}},
                                         {azimuth_name, {"beam"}},
                                         {elevation_name, {"beam"}},
                                         {pose_name, {"ping"}},
                                         {time_name, {"ping"}},
                                         {ping_name, {"ping"}},
                                         {velocity_name, {"ping"}},
                                         {turn_rate_name, {"ping"}},
                                         {beam_time_name, {"ping", "beam"}},
                                         {beam_pose_name, {"ping", "beam"}},
                                         {scan_angle_name, {"ping"}},
                                         {sweep_name, {"ping"}}};
/// The dataset that is the scale of a kind of dimension.
struct CubeScale {
  const char* dimension;
  DatasetName name;
};
constexpr CubeScale cube_scales[] = {{"ping", ping_name}, {"beam", azimuth_name}, {"bin", range_name}};

}  // namespace insonify
