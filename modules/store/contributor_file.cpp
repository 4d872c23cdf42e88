// SPDX-License-Identifier: BSD-3-Clause
#include "store/contributor_file.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "hdf/hdf5_internal.hpp"
#include "returns/label_objects.hpp"

namespace insonify {

using namespace hdf5;

namespace {

constexpr std::int64_t contributor_schema = 1;
const std::string content = "contributors";
constexpr DatasetName surfel_name{"/surfel", ""}, id_name{"/id", ""}, share_name{"/share", ""},
    elevations_name{"/elevation", "rad"}, material_name{"/material", ""}, path_name{"/path", ""},
    material_image_name{"/material_image", ""}, instance_image_name{"/instance_image", ""},
    names_name{"/material_names", ""}, before_name{"/surfel_before", ""};

/// Calls use(name, list) for the lists of contributors that each file has, in the order of their datasets.
template <typename Use>
void for_each_list(const Contributors& c, const Use& use) {
  use(surfel_name, c.surfel);
  use(id_name, c.id);
  use(share_name, c.share);
  use(elevations_name, c.elevation);
  use(material_name, c.material);
  use(path_name, c.path);
}

template <typename Number>
void send_numbers(const FileContext& context, hid_t file, const DatasetName& name, const Extent& extent,
                  ArraySender& to) {
  const Handle dataset = open_dataset(context, file, name);
  if (extent_of(context, dataset, name.path, 3) != extent)
    fail(context.kind, context.path, ": ", name.path, " differs in extent from ", surfel_name.path);
  Number* const numbers = to.take_array<Number>(extent[0] * extent[1] * extent[2]);
  read_values(context, dataset, {type_of<Number>(false)}, numbers, name.path);
}

void write_names(const FileContext& context, hid_t file, const std::vector<std::string>& names) {
  std::size_t length = 1;
  for (const std::string& name : names) length = std::max(length, name.size() + 1);
  std::string text(names.size() * length, '\0');
  for (std::size_t i = 0; i < names.size(); ++i) text.replace(i * length, names[i].size(), names[i]);
  const Handle type = text_type(context, length);
  const Handle dataset = create_dataset(context, file, names_name, type, {names.size()});
  context.checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), names_name.path);
}

std::vector<std::string> read_names(const FileContext& context, hid_t file) {
  const Handle dataset = open_dataset(context, file, names_name);
  const Extent extent = extent_of(context, dataset, names_name.path, 1);
  const Handle stored(context.checked(H5Dget_type(dataset), names_name.path), H5Tclose);
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) > 0)
    fail(context.kind, context.path, ": ", names_name.path, " must be text of fixed length");
  const std::size_t length = H5Tget_size(stored);
  std::string text(extent[0] * length, '\0');
  read_values(context, dataset, {stored}, text.data(), names_name.path);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < extent[0]; ++i) names.emplace_back(text.substr(i * length, length).c_str());
  return names;
}

void require_ours(const FileContext& context, hid_t file) {
  if (H5Aexists(file, "content") <= 0 || read_text(context, file, "content") != content)
    fail(context.kind, context.path, ": is not a contributor file of insonify: attribute 'content' is not \"", content,
         "\"");
  const std::int64_t schema = read_attribute<std::int64_t>(context, file, "schema");
  if (schema != contributor_schema)
    fail(context.kind, context.path, ": has contributor schema ", schema, ", this version reads schema ",
         contributor_schema);
}

/// Returns the number of beams in a chunk of about 256 kB.
hsize_t beams_per_chunk(const Extent& lists) {
  return std::clamp<hsize_t>((hsize_t{1} << 16) / (lists[1] * lists[2]), 1, lists[0]);
}

void require_named_materials(const Contributors& c, std::size_t names, const std::string& path) {
  for (const std::uint16_t m : c.material)
    if (m != Contributors::no_material && m >= names)
      fail(ErrorKind::argument, "ContributorFile: ", path, ": material ", m, " has no name, there are ", names);
}

}  // namespace

struct ContributorFile::Open {
  FileContext context;
  Extent lists;
  std::size_t materials;
  PendingFile pending;
  Handle file;
  std::vector<Handle> datasets{};

  Open(const std::string& path, Extent extent, std::size_t names)
      : context{path, ErrorKind::file},
        lists(std::move(extent)),
        materials(names),
        pending(path),
        file(create_file(context, pending.temporary())) {}

  template <typename Number>
  void add(const DatasetName& name) {
    datasets.push_back(create_dataset(context, file, name, type_of<Number>(true), lists,
                                      {beams_per_chunk(lists), lists[1], lists[2]}, Packing::deflate));
  }
  void begin(const std::vector<std::string>& names, bool two_surfaces) {
    write_attribute(context, file, "schema", contributor_schema);
    write_attribute(context, file, "content", content);
    write_attribute(context, file, "paths",
                    std::string("0 direct, 1 one bounce, 2 two bounces") + (two_surfaces ? ", 3 two surfaces" : ""));
    for_each_list({}, [&]<typename Number>(auto& name, const std::vector<Number>&) { add<Number>(name); });
    if (two_surfaces) add<std::uint32_t>(before_name);
    write_names(context, file, names);
  }
  /// Writes the lists of a band of beams.
  template <typename Number>
  void write(std::size_t dataset, const DatasetName& name, std::size_t first_beam, std::size_t beams,
             const Number* numbers) {
    const Extent count = {beams, lists[1], lists[2]};
    const Handle here = space_of(context, count), there = block_of(context, lists, {first_beam, 0, 0}, count);
    context.checked(H5Dwrite(datasets[dataset], type_of<Number>(false), here, there, H5P_DEFAULT, numbers), name.path);
  }
  void write(const Contributors& band, std::size_t first_beam) {
    std::size_t dataset = 0;
    for_each_list(band, [&](auto& name, auto& list) { write(dataset++, name, first_beam, band.beams, list.data()); });
    if (datasets.size() <= dataset) return;
    const std::vector<std::uint32_t> none(band.surfel_before.empty() ? band.surfel.size() : 0, Contributors::none);
    write(dataset, before_name, first_beam, band.beams, none.empty() ? band.surfel_before.data() : none.data());
  }
  void write_image(const DatasetName& name, const auto& image) {
    using Number = typename std::decay_t<decltype(image)>::Scalar;
    const Extent extent = {lists[0], lists[1]};
    const Handle dataset = create_dataset(context, file, name, type_of<Number>(true), extent,
                                          {beams_per_chunk(lists), lists[1]}, Packing::deflate);
    context.checked(H5Dwrite(dataset, type_of<Number>(false), H5S_ALL, H5S_ALL, H5P_DEFAULT, image.data()), name.path);
  }
};

ContributorFile::ContributorFile(const std::string& path, std::size_t beams, std::size_t bins, std::size_t per_pixel,
                                 const std::vector<std::string>& materials, bool two_surfaces) {
  const QuietErrors quiet;
  open_ = std::make_unique<Open>(path, Extent{beams, bins, per_pixel}, materials.size());
  write_checked(open_->context, [&] { open_->begin(materials, two_surfaces); });
}

ContributorFile::~ContributorFile() {
  const QuietErrors quiet;  // silences the closing of a file that could not be written
  open_.reset();
}

void ContributorFile::write(const Contributors& band, std::size_t first_beam) {
  const QuietErrors quiet;
  const Extent& lists = open_->lists;
  require_valid(band, "ContributorFile");
  require_named_materials(band, open_->materials, open_->context.path);
  if (band.bins != lists[1] || band.per_pixel != lists[2] || first_beam + band.beams > lists[0])
    fail(ErrorKind::argument, "ContributorFile: ", open_->context.path, ": beams ", first_beam, " to ",
         first_beam + band.beams, " of ", band.bins, " x ", band.per_pixel, " entries, must be within ", lists[0],
         " beams of ", lists[1], " x ", lists[2]);
  write_checked(open_->context, [&] { open_->write(band, first_beam); });
}

void ContributorFile::finish(const Grid<std::uint16_t>& material_image, const Grid<std::uint32_t>& instance_image) {
  for (const auto& [rows, columns] : {std::pair(material_image.rows(), material_image.cols()),
                                      std::pair(instance_image.rows(), instance_image.cols())})
    if (static_cast<hsize_t>(rows) != open_->lists[0] || static_cast<hsize_t>(columns) != open_->lists[1])
      fail(ErrorKind::argument, "ContributorFile: ", open_->context.path, ": labels of ", rows, " x ", columns,
           " pixels, must be of ", open_->lists[0], " x ", open_->lists[1]);
  {
    const QuietErrors quiet;
    write_checked(open_->context, [&] {
      open_->write_image(material_image_name, material_image);
      open_->write_image(instance_image_name, instance_image);
      open_->datasets.clear();
      const Handle last = std::move(open_->file);  // a full disk shows when the file is closed
    });
  }
  open_->pending.commit();
}

std::uintmax_t contributor_bytes(const std::string& path) {
  constexpr std::uintmax_t bytes_of_entry = 19;
  Extent extent;
  read_hdf5(path, [](const FileContext& context, hid_t file, ArraySender& to) {
    require_ours(context, file);
    to(extent_of(context, open_dataset(context, file, surfel_name), surfel_name.path, 3));
  })(extent);
  return bytes_of_entry * extent[0] * extent[1] * extent[2];
}

NamedContributors read_contributor_file(const std::string& path) {
  ArrayReceiver sent = read_hdf5(path, [](const FileContext& context, hid_t file, ArraySender& to) {
    require_ours(context, file);
    const Extent extent = extent_of(context, open_dataset(context, file, surfel_name), surfel_name.path, 3);
    to(extent);
    for_each_list({}, [&]<typename Number>(auto& name, const std::vector<Number>&) {
      send_numbers<Number>(context, file, name, extent, to);
    });
    if (H5Lexists(file, before_name.path, H5P_DEFAULT) > 0)
      send_numbers<std::uint32_t>(context, file, before_name, extent, to);
    else
      to(std::vector<std::uint32_t>{});
    to(read_names(context, file));
  });
  NamedContributors named;
  Contributors& c = named.contributors;
  Extent extent;
  sent(extent, c.surfel, c.id, c.share, c.elevation, c.material, c.path, c.surfel_before, named.materials);
  c.beams = extent[0], c.bins = extent[1], c.per_pixel = extent[2];
  for (const PathKind kind : c.path)
    if (kind > PathKind::two_surfaces)
      fail(ErrorKind::content, path, ": ", path_name.path, " holds ", static_cast<int>(kind), ", must be 0, 1, 2 or 3");
  return named;
}

}  // namespace insonify
