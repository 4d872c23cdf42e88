#pragma once
#include <cstdint>

namespace insonify {

/// Version of the layout of cube.h5, raised when readers of the previous one would fail.
constexpr std::int64_t cube_schema = 1;

/// Path of a dataset in the file, and its unit for the attribute "units" ("": none).
struct DatasetName {
  const char* path;
  const char* unit;
};
constexpr DatasetName pressure_name{"/pressure", "Pa"};
/// Group of the layers, each a dataset like /pressure; absent without layers.
constexpr const char* layers_group = "/layers";
/// Optional maps of the extent of /pressure, one real number per cell.
constexpr DatasetName intensity_name{"/intensity", "Pa^2"};
constexpr DatasetName level_error_name{"/level_error_db", "dB"};
constexpr DatasetName unknown_name{"/unknown", ""};
constexpr DatasetName split_phase_name{"/split_phase", "rad"};
constexpr DatasetName label_material_name{"/label_material", ""};
constexpr DatasetName label_id_name{"/label_id", ""};
constexpr DatasetName label_share_name{"/label_share", ""};
/// Root attribute: names of the materials of /label_material, one a line.
constexpr const char* label_names_attribute = "label_names";
/// Root attribute: significant bits of the pressures, if they are rounded.
constexpr const char* keep_bits_attribute = "keep_bits";
/// Root attribute that marks a cube whose pressures are roots of expected intensities.
constexpr const char* expected_level_attribute = "expected_level";
constexpr const char* expected_level_text = "expected level, no speckle";
constexpr DatasetName range_name{"/range", "m"};
constexpr DatasetName azimuth_name{"/azimuth", "rad"};
constexpr DatasetName elevation_name{"/elevation", "rad"};
constexpr DatasetName pose_name{"/pose", "m"};
constexpr DatasetName time_name{"/time", "s"};
constexpr DatasetName ping_name{"/ping", ""};
/// Of pings whose water differs: what the root attributes of these names say of all others.
constexpr DatasetName sound_speed_name{"/sound_speed", "m/s"};
constexpr DatasetName absorption_name{"/absorption_db_per_m", "dB/m"};
/// Of a scanning head alone: time and pose of every beam, and the head's own turn.
constexpr DatasetName beam_time_name{"/beam_time", "s"};
constexpr DatasetName beam_pose_name{"/beam_pose", "m"};
constexpr DatasetName scan_angle_name{"/scan_angle", "rad"};
constexpr DatasetName sweep_name{"/sweep", ""};

}  // namespace insonify
