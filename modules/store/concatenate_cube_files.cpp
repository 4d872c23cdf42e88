// SPDX-License-Identifier: BSD-3-Clause
#include "store/concatenate_cube_files.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "hdf/hdf5_internal.hpp"
#include "store/cube_arrays_internal.hpp"
#include "store/cube_axes_internal.hpp"

namespace insonify {

using namespace hdf5;
namespace {

/// Values per ping that are copied: those of all parts, one part after the other.
struct Track {
  DatasetName name;
  bool whole_numbers;
  enum class Without {
    nothing,    ///< a part without it has no values
    attribute,  ///< a part without it has one value for all pings, the root attribute of that name
    rest        ///< a part without it is of a head at rest: zeros
  } without = Without::nothing;
  Extent extent{};  ///< extent of all parts; empty: the first part has none
  std::vector<char> bytes{};

  hid_t type(bool in_file) const { return whole_numbers ? type_of<std::int64_t>(in_file) : type_of<double>(in_file); }
};

struct Source {
  std::string path;
  hsize_t pings;
};

struct JoinedCube {
  std::string sonar;
  Extent extent;  ///< extent of /pressure
  std::vector<Source> sources;
  std::vector<std::string> images;
  std::vector<PingNote> notes{};
  std::vector<Track> tracks = {{time_name, false},
                               {pose_name, false},
                               {ping_name, true},
                               {sound_speed_name, false, Track::Without::attribute},
                               {absorption_name, false, Track::Without::attribute},
                               {velocity_name, false, Track::Without::rest},
                               {turn_rate_name, false, Track::Without::rest},
                               {part_views_name, false},
                               {scan_angle_name, false},
                               {sweep_name, true},
                               {beam_time_name, false},
                               {beam_pose_name, false}};
};

std::vector<std::string> images_of(const FileContext& context, hid_t file) {
  std::vector<std::string> images{image_name_of(file).path};
  for (const std::string& layer : names_in(context, file, layers_group))
    images.push_back(std::string(layers_group) + "/" + layer);
  for (const DatasetName& map :
       {intensity_name, unknown_name, split_phase_name, label_material_name, label_id_name, label_share_name,
        label_part_name, label_elevation_name, label_second_name, label_second_share_name})
    if (H5Lexists(file, map.path, H5P_DEFAULT) > 0) images.emplace_back(map.path);
  return images;
}

/// Reads the values of a part's track. Returns their extent, which is empty if the part has none.
Extent read_values_of(const FileContext& context, hid_t file, Track& track, hsize_t pings) {
  const std::size_t before = track.bytes.size();
  if (H5Lexists(file, track.name.path, H5P_DEFAULT) <= 0) {
    if (track.without == Track::Without::nothing) return {};
    const bool rest = track.without == Track::Without::rest;
    const std::vector<double> same(rest ? 3 * pings : pings,
                                   rest ? 0 : read_attribute(context, file, track.name.path + 1));
    track.bytes.resize(before + 8 * same.size());
    std::memcpy(track.bytes.data() + before, same.data(), 8 * same.size());
    return rest ? Extent{pings, 3} : Extent{pings};
  }
  const Handle dataset = open_dataset(context, file, track.name);
  const Extent extent = extent_of(context, dataset, track.name.path);
  track.bytes.resize(before + 8 * std::accumulate(extent.begin(), extent.end(), hsize_t{1}, std::multiplies<>()));
  read_values(context, dataset, {track.type(false)}, track.bytes.data() + before, track.name.path);
  return extent;
}

void add_track(const FileContext& context, hid_t file, Track& track, hsize_t pings) {
  const Extent extent = read_values_of(context, file, track, pings);
  if (extent.empty()) return;
  if (track.extent.empty()) (track.extent = extent)[0] = 0;
  if (!std::equal(extent.begin() + 1, extent.end(), track.extent.begin() + 1, track.extent.end()))
    fail(ErrorKind::content, context.path, ": ", track.name.path,
         " has another shape than in the cubes before; make all of them with one version of insonify");
  track.extent[0] += extent[0];
}

void add_part(JoinedCube& joined, const std::string& path) {
  const FileContext context{path, ErrorKind::content};
  const Handle file = open_file(context);
  const Extent extent =
      extent_of(context, open_dataset(context, file, image_name_of(file)), image_name_of(file).path, 3);
  const std::string sonar = read_text(context, file, "sonar");
  if (H5Aexists(file, notes_attribute) > 0) gather(joined.notes, notes_in(read_text(context, file, notes_attribute)));
  const std::vector<std::string> images = images_of(context, file);
  if (joined.sources.empty()) {
    joined.sonar = sonar, joined.extent = extent, joined.images = images;
  } else {
    if (sonar != joined.sonar || extent[1] != joined.extent[1] || extent[2] != joined.extent[2])
      fail(ErrorKind::content, path, ": is of sonar ", sonar, " with ", extent[1], " beams and ", extent[2],
           " bins, not ", joined.sonar, " with ", joined.extent[1], " and ", joined.extent[2], " as in ",
           joined.sources.front().path);
    joined.extent[0] += extent[0];
    std::erase_if(joined.images, [&](const std::string& name) {
      return std::find(images.begin(), images.end(), name) == images.end();
    });
  }
  joined.sources.push_back({path, extent[0]});
  for (Track& track : joined.tracks) add_track(context, file, track, extent[0]);
}

/// The file from which attributes are copied, and the object that gets them.
using Copy = std::pair<const FileContext&, hid_t>;

herr_t copy_attribute(hid_t from, const char* name, const H5A_info_t*, void* to) try {
  if (names_dimensions(name) || name == std::string(notes_attribute)) return 0;
  const Copy& copy = *static_cast<const Copy*>(to);
  const Handle attribute(H5Aopen(from, name, H5P_DEFAULT), H5Aclose), type(H5Aget_type(attribute), H5Tclose),
      space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1) return -1;
  const Handle made(H5Acreate2(copy.second, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (H5Tis_variable_str(type) > 0) {
    const std::string text = read_text(copy.first, from, name);
    const char* characters = text.c_str();
    return H5Awrite(made, type, &characters);
  }
  std::vector<char> value(H5Tget_size(type));
  return H5Aread(attribute, type, value.data()) < 0 ? -1 : H5Awrite(made, type, value.data());
} catch (const Error&) {  // an exception must not pass through HDF5
  return -1;
}

void copy_axes(const FileContext& context, const FileContext& from, hid_t first, hid_t file) {
  Copy copy{from, file};
  context.checked(H5Aiterate2(first, H5_INDEX_NAME, H5_ITER_INC, nullptr, copy_attribute, &copy), "attributes");
  const Handle bare(context.checked(H5Pcreate(H5P_OBJECT_COPY), "axes"), H5Pclose);
  context.checked(H5Pset_copy_object(bare, H5O_COPY_WITHOUT_ATTR_FLAG), "axes");
  for (const DatasetName& axis : {range_name, azimuth_name, elevation_name}) {
    context.checked(H5Ocopy(first, axis.path, file, axis.path, bare, H5P_DEFAULT), axis.path);
    const Handle source = open_dataset(from, first, axis), made = open_dataset(context, file, axis);
    Copy attributes{from, made};
    context.checked(H5Aiterate2(source, H5_INDEX_NAME, H5_ITER_INC, nullptr, copy_attribute, &attributes), axis.path);
  }
}

/// Returns true if a cube without this track reads with the same values.
bool goes_without(const FileContext& from, hid_t first, const Track& track) {
  if (track.without == Track::Without::nothing) return false;
  std::vector<double> values(track.bytes.size() / 8);
  std::memcpy(values.data(), track.bytes.data(), track.bytes.size());
  const double same = track.without == Track::Without::rest ? 0 : read_attribute(from, first, track.name.path + 1);
  return std::all_of(values.begin(), values.end(), [same](double value) { return value == same; });
}

void write_tracks(const FileContext& context, hid_t file, const JoinedCube& joined, const FileContext& from,
                  hid_t first) {
  for (const Track& track : joined.tracks) {
    if (track.extent.empty() || goes_without(from, first, track)) continue;
    const Handle dataset = create_dataset(context, file, track.name, track.type(true), track.extent);
    context.checked(H5Dwrite(dataset, track.type(false), H5S_ALL, H5S_ALL, H5P_DEFAULT, track.bytes.data()),
                    track.name.path);
  }
}

Handle rows(const FileContext& context, const Extent& extent, hsize_t first, hsize_t count) {
  return block_of(context, extent, {first, 0, 0}, {count, extent[1], extent[2]});
}

/// Makes `properties` refer to the parts. Values of a part that is missing later read as NaN, levels as no_level.
void refer_to_parts(const FileContext& context, const JoinedCube& joined, const std::string& image, hid_t type,
                    hid_t properties) {
  const std::filesystem::path folder = std::filesystem::path(context.path).parent_path();
  hsize_t first = 0;
  for (const Source& source : joined.sources) {
    const Extent there = {source.pings, joined.extent[1], joined.extent[2]};
    const Handle here = rows(context, joined.extent, first, source.pings), from = rows(context, there, 0, source.pings);
    const std::string name = std::filesystem::relative(source.path, folder.empty() ? "." : folder).string();
    context.checked(H5Pset_virtual(properties, here, name.c_str(), image.c_str(), from), image);
    first += source.pings;
  }
  const float missing[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN()};
  const bool levels = H5Tget_class(type) == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_2;
  context.checked(H5Pset_fill_value(properties, type, levels ? static_cast<const void*>(&no_level) : missing), image);
}

/// Copies an image of all parts, a few pings at a time, in the type that it has in the first of them.
void copy_images(const FileContext& context, const JoinedCube& joined, const std::string& image, hid_t type,
                 hid_t dataset) {
  constexpr hsize_t bytes_at_once = 4 << 20;
  const hsize_t bytes = joined.extent[1] * joined.extent[2] * H5Tget_size(type);
  const hsize_t at_once = std::max<hsize_t>(1, bytes_at_once / std::max<hsize_t>(1, bytes));
  const auto send = [](const FileContext& from, hid_t file, ArraySender& to, const std::string& like,
                       const std::string& name, const Extent& all, hsize_t begin, hsize_t some) {
    const FileContext like_context{like, from.kind};
    const Handle like_file = open_file(like_context), source = open_dataset(from, file, {name.c_str(), ""});
    const Handle like_image = open_dataset(like_context, like_file, {name.c_str(), ""});
    const Handle stored(from.checked(H5Dget_type(like_image), name), H5Tclose);
    const Handle there = rows(from, all, begin, some), here = rows(from, {some, all[1], all[2]}, 0, some);
    read_values(from, source, {stored, here, there}, to.take(some * all[1] * all[2] * H5Tget_size(stored)), name);
  };
  hsize_t row = 0;
  for (const Source& source : joined.sources) {
    const Extent extent = {source.pings, joined.extent[1], joined.extent[2]};
    for (hsize_t first = 0; first < source.pings; first += at_once) {
      const hsize_t count = std::min(at_once, source.pings - first);
      ArrayReceiver sent = read_hdf5(source.path, send, joined.sources.front().path, image, extent, first, count);
      context.checked(H5Dwrite(dataset, type, rows(context, {count, extent[1], extent[2]}, 0, count),
                               rows(context, joined.extent, row, count), H5P_DEFAULT, sent.take(count * bytes)),
                      image);
      row += count;
    }
  }
}

struct Join {
  bool copy;           ///< true: images are copied; false: the cube refers to them
  bool tried = false;  ///< true: a trial without the numbers of images
};

void write_image(const FileContext& context, const JoinedCube& joined, const std::string& image,
                 const FileContext& from, hid_t first, hid_t file, Join join) {
  const Handle like = open_dataset(context, first, {image.c_str(), ""});
  const Handle type(context.checked(H5Dget_type(like), image), H5Tclose);
  const Handle properties(context.checked(join.copy ? H5Dget_create_plist(like) : H5Pcreate(H5P_DATASET_CREATE), image),
                          H5Pclose);
  context.checked(H5Pset_obj_track_times(properties, false), image);
  if (!join.copy) refer_to_parts(context, joined, image, type, properties);
  const Handle space = space_of(context, joined.extent);
  const Handle dataset(
      context.checked(H5Dcreate2(file, image.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), image),
      H5Dclose);
  Copy attributes{from, dataset};
  context.checked(H5Aiterate2(like, H5_INDEX_NAME, H5_ITER_INC, nullptr, copy_attribute, &attributes), image);
  if (join.copy && !join.tried) copy_images(context, joined, image, type, dataset);
}

/// Creates a file that exists in memory only. HDF5 looks for its name, so that must not be the name of a file.
Handle create_in_memory(const FileContext& context) {
  const Handle access(context.checked(H5Pcreate(H5P_FILE_ACCESS), "file"), H5Pclose);
  context.checked(H5Pset_fapl_core(access, std::size_t{1} << 20, false), "file");
  return {context.checked(H5Fcreate((context.path + "/tried").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "file"),
          H5Fclose};
}

void join_files(const std::string& path, const std::vector<std::string>& sources, Join join) {
  const QuietErrors quiet;
  JoinedCube joined;
  for (const std::string& source : sources) add_part(joined, source);
  const FileContext from{sources.front(), ErrorKind::content};
  const Handle first = open_file(from);
  const auto write = [&](const FileContext& context, hid_t file) {
    copy_axes(context, from, first, file);
    if (!joined.notes.empty()) write_attribute(context, file, notes_attribute, as_lines(joined.notes));
    write_tracks(context, file, joined, from, first);
    const auto is_layer = [](const std::string& image) { return image.starts_with(layers_group); };
    if (std::any_of(joined.images.begin(), joined.images.end(), is_layer))
      create_ordered_group(context, file, layers_group);
    for (const std::string& image : joined.images) write_image(context, joined, image, from, first, file, join);
    if (!join.tried) name_dimensions(context, file);  // needs the numbers of images
  };
  if (!join.tried) return write_hdf5(path, write);
  const FileContext nowhere{path, ErrorKind::file};
  write(nowhere, create_in_memory(nowhere));
}

}  // namespace

void concatenate_cube_files(const std::string& path, const std::vector<std::string>& sources, bool copy) {
  if (sources.empty()) fail(ErrorKind::argument, "concatenate_cube_files: ", path, ": no parts, must be at least one");
  // A child process makes every call of HDF5 on the parts first, so that no damaged part ends this process.
  std::size_t bytes = 0;
  for (const std::string& source : sources) require_regular_file(source), bytes += size_of_file(source);
  const auto attempt = [](ArraySender&, auto& to, auto& from, bool all) { join_files(to, from, {all, true}); };
  read_apart(sources.front(), limits_of_file(bytes), attempt, path, sources, copy);
  join_files(path, sources, {copy});
}

}  // namespace insonify
