#include "store/contributor_file.hpp"

#include <algorithm>
#include <type_traits>

#include "core/error.hpp"
#include "store/hdf5_internal.hpp"

namespace insonify {

using namespace hdf5;

namespace {

constexpr std::int64_t contributor_schema = 1;
const std::string content = "contributors";
constexpr DatasetName surfel_name{"/surfel", ""}, id_name{"/id", ""}, share_name{"/share", ""},
    elevations_name{"/elevation", "rad"}, material_name{"/material", ""}, path_name{"/path", ""},
    material_image_name{"/material_image", ""}, instance_image_name{"/instance_image", ""},
    names_name{"/material_names", ""};

template <typename Number>
void read_numbers(const Place& place, hid_t file, const DatasetName& name, const Extent& extent,
                  std::vector<Number>& numbers) {
  const Handle dataset = open_dataset(place, file, name);
  if (extent_of(place, dataset, name.path, 3) != extent)
    fail(place.kind, place.path, ": ", name.path, " differs in extent from ", surfel_name.path);
  numbers.resize(extent[0] * extent[1] * extent[2]);
  place.checked(H5Dread(dataset, type_of<Number>(false), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), name.path);
}

void write_names(const Place& place, hid_t file, const std::vector<std::string>& names) {
  std::size_t length = 1;
  for (const std::string& name : names) length = std::max(length, name.size() + 1);
  std::string text(names.size() * length, '\0');
  for (std::size_t i = 0; i < names.size(); ++i) text.replace(i * length, names[i].size(), names[i]);
  const Handle type = text_type(place, length);
  const Handle dataset = create_dataset(place, file, names_name, type, {names.size()});
  place.checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), names_name.path);
}

std::vector<std::string> read_names(const Place& place, hid_t file) {
  const Handle dataset = open_dataset(place, file, names_name);
  const Extent extent = extent_of(place, dataset, names_name.path, 1);
  const Handle stored(place.checked(H5Dget_type(dataset), names_name.path), H5Tclose);
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) > 0)
    fail(place.kind, place.path, ": ", names_name.path, " must be text of fixed length");
  const std::size_t length = H5Tget_size(stored);
  std::string text(extent[0] * length, '\0');
  place.checked(H5Dread(dataset, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), names_name.path);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < extent[0]; ++i) names.emplace_back(text.substr(i * length, length).c_str());
  return names;
}

void require_ours(const Place& place, hid_t file) {
  if (H5Aexists(file, "content") <= 0 || read_text(place, file, "content") != content)
    fail(place.kind, place.path, ": is not a contributor file of insonify: attribute 'content' is not \"", content,
         "\"");
  const std::int64_t schema = read_integer(place, file, "schema");
  if (schema != contributor_schema)
    fail(place.kind, place.path, ": has contributor schema ", schema, ", this version reads schema ",
         contributor_schema);
}

void require_named(const NamedContributors& named, const std::string& path) {
  require_valid(named.contributors, "write_contributor_file");
  const PixelLabels& labels = named.labels;
  if (!labels.empty() && (static_cast<std::size_t>(labels.material.rows()) != named.contributors.beams ||
                          static_cast<std::size_t>(labels.material.cols()) != named.contributors.bins))
    fail(ErrorKind::argument, "write_contributor_file: ", path, ": labels of ", labels.material.rows(), " x ",
         labels.material.cols(), " pixels, must be of ", named.contributors.beams, " x ", named.contributors.bins);
  for (const std::uint16_t m : named.contributors.material)
    if (m != Contributors::no_material && m >= named.materials.size())
      fail(ErrorKind::argument, "write_contributor_file: ", path, ": material ", m, " has no name, there are ",
           named.materials.size());
}

}  // namespace

void write_contributor_file(const std::string& path, const NamedContributors& named) {
  require_named(named, path);
  const Contributors& c = named.contributors;
  write_hdf5(path, [&](const Place& place, hid_t file) {
    write_attribute(place, file, "schema", contributor_schema);
    write_attribute(place, file, "content", content);
    write_attribute(place, file, "paths", std::string("0 direct, 1 one bounce, 2 two bounces"));
    const Extent lists = {c.beams, c.bins, c.per_pixel}, image = {c.beams, c.bins};
    write_numbers(place, file, surfel_name, lists, c.surfel.data());
    write_numbers(place, file, id_name, lists, c.id.data());
    write_numbers(place, file, share_name, lists, c.share.data());
    write_numbers(place, file, elevations_name, lists, c.elevation.data());
    write_numbers(place, file, material_name, lists, c.material.data());
    static_assert(sizeof(PathKind) == 1);
    write_numbers(place, file, path_name, lists, reinterpret_cast<const std::uint8_t*>(c.path.data()));
    const bool labelled = !named.labels.empty();
    write_numbers(place, file, material_image_name, image,
                  (labelled ? material_image(named.labels) : material_image(c)).data());
    write_numbers(place, file, instance_image_name, image,
                  (labelled ? instance_image(named.labels) : instance_image(c)).data());
    write_names(place, file, named.materials);
  });
}

std::uintmax_t contributor_bytes(const std::string& path) {
  constexpr std::uintmax_t bytes_of_entry = 19;
  const QuietErrors quiet;
  const Place place{path, ErrorKind::content};
  const Handle file = open_file(place);
  require_ours(place, file);
  const Extent extent = extent_of(place, open_dataset(place, file, surfel_name), surfel_name.path, 3);
  return bytes_of_entry * extent[0] * extent[1] * extent[2];
}

NamedContributors read_contributor_file(const std::string& path) {
  const QuietErrors quiet;
  const Place place{path, ErrorKind::content};
  const Handle file = open_file(place);
  require_ours(place, file);
  NamedContributors named;
  Contributors& c = named.contributors;
  const Extent extent = extent_of(place, open_dataset(place, file, surfel_name), surfel_name.path, 3);
  c.beams = extent[0], c.bins = extent[1], c.per_pixel = extent[2];
  read_numbers(place, file, surfel_name, extent, c.surfel);
  read_numbers(place, file, id_name, extent, c.id);
  read_numbers(place, file, share_name, extent, c.share);
  read_numbers(place, file, elevations_name, extent, c.elevation);
  read_numbers(place, file, material_name, extent, c.material);
  std::vector<std::uint8_t> kinds;
  read_numbers(place, file, path_name, extent, kinds);
  for (const std::uint8_t kind : kinds) {
    if (kind > static_cast<std::uint8_t>(PathKind::two_bounces))
      fail(place.kind, path, ": ", path_name.path, " holds ", int{kind}, ", must be 0, 1 or 2");
    c.path.push_back(static_cast<PathKind>(kind));
  }
  named.materials = read_names(place, file);
  return named;
}

}  // namespace insonify
