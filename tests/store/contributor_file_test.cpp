// SPDX-License-Identifier: BSD-3-Clause
#include "store/contributor_file.hpp"

#include "returns/label_objects.hpp"
#include "store/raw_file.hpp"
#include "store/run_directory.hpp"
#include "support/test.hpp"

namespace {

/// Returns 5 beams x 7 bins x 3; the last pixel is empty.
NamedContributors make_contributors() {
  NamedContributors named;
  named.materials = {"fine sand", "", "Fels, grün"};
  Contributors& c = named.contributors;
  c.beams = 5, c.bins = 7, c.per_pixel = 3;
  for (std::uint32_t i = 0; i < 5 * 7 * 3; ++i) {
    const bool empty = i >= 4 * 7 * 3 + 6 * 3;
    c.surfel.push_back(empty ? Contributors::none : 4000000000U - i);
    c.id.push_back(empty ? Contributors::none : 3 * i);
    c.share.push_back(empty ? 0 : 0.5F / static_cast<float>(1 + i % 3));
    c.elevation.push_back(empty ? 0 : -0.01F * static_cast<float>(i));
    c.material.push_back(empty ? Contributors::no_material : static_cast<std::uint16_t>(i % 3));
    c.path.push_back(empty ? PathKind::direct : static_cast<PathKind>((i / 3) % 3));
  }
  return named;
}

// Returns the connected parts of the material of the strongest contributors.
Grid<std::uint32_t> objects_of(const Contributors& c) {
  return connected_groups(material_image(c).unaryExpr([](std::uint16_t material) {
    return material == Contributors::no_material ? 0 : std::uint32_t{material} + 1;
  }),
                          1);
}

void write_to(const std::string& path, const NamedContributors& named) {
  const Contributors& c = named.contributors;
  ContributorFile file(path, c.beams, c.bins, c.per_pixel, named.materials, !c.surfel_before.empty());
  file.write(c, 0);
  file.finish(material_image(c), objects_of(c));
}

std::string write(const NamedContributors& named, const std::string& name = "c.h5") {
  const std::string path = own_path(name);
  write_to(path, named);
  return path;
}

std::string error_of_contributors(const std::string& path) {
  return replaced(error_with_kind([&] { read_contributor_file(path); }), path, "c.h5");
}

}  // namespace

TEST(ContributorFile, comes_back_bit_for_bit) {
  const NamedContributors named = make_contributors(), back = read_contributor_file(write(named));
  const Contributors &a = named.contributors, &b = back.contributors;
  EXPECT_EQ(b.beams, 5U);
  EXPECT_EQ(b.bins, 7U);
  EXPECT_EQ(b.per_pixel, 3U);
  const auto fields = [](const auto& x) { return std::tie(x.surfel, x.id, x.share, x.elevation, x.material, x.path); };
  EXPECT_EQ(fields(a), fields(b));
  EXPECT_EQ(named.materials, back.materials);
}

TEST(ContributorFile, names_the_surfel_before_the_last) {
  NamedContributors named = make_contributors();
  Contributors& c = named.contributors;
  c.surfel_before.assign(c.surfel.size(), Contributors::none);
  c.path[4] = PathKind::two_surfaces, c.surfel_before[4] = 17;
  EXPECT_EQ(read_contributor_file(write(named)).contributors.surfel_before, c.surfel_before);
  c.surfel_before.pop_back();
  EXPECT_THAT(error_of([&] { write(named); }), HasSubstr("surfel_before has 104 entries, must have none or 105"));
}

TEST(ContributorFile, in_bands_is_the_same_file) {
  const NamedContributors named = make_contributors();
  const Contributors& c = named.contributors;
  const std::string path = own_path("bands.h5");
  ContributorFile file(path, c.beams, c.bins, c.per_pixel, named.materials);
  for (const auto& [first, end] : {std::pair<std::size_t, std::size_t>{0, 2}, {2, 5}}) {
    Contributors band;
    band.beams = end - first, band.bins = c.bins, band.per_pixel = c.per_pixel;
    const auto cut = [&, begin = static_cast<long>(c.at(first, 0)), stop = static_cast<long>(c.at(end, 0))](
                         const auto& from, auto& to) { to.assign(from.begin() + begin, from.begin() + stop); };
    cut(c.surfel, band.surfel);
    cut(c.id, band.id);
    cut(c.share, band.share);
    cut(c.elevation, band.elevation);
    cut(c.material, band.material);
    cut(c.path, band.path);
    file.write(band, first);
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_THAT(error_with_kind([&] { file.write(band, 4); }), testing::HasSubstr("must be within 5 beams of 7 x 3"));
  }
  file.finish(material_image(c), objects_of(c));
  EXPECT_EQ(file_bytes(path), file_bytes(write(named)));
}

TEST(ContributorFile, has_the_documented_layout) {
  const NamedContributors named = make_contributors();
  const RawFile file(write(named));
  for (const char* name : {"/surfel", "/id", "/share", "/elevation", "/material", "/path"})
    EXPECT_EQ(raw_extent(file, name), (std::vector<hsize_t>{5, 7, 3})) << name;
  const hid_t materials = H5Dopen2(file, "/material_image", H5P_DEFAULT), material_type = H5Dget_type(materials);
  EXPECT_GT(H5Tequal(material_type, H5T_STD_U16LE), 0);
  H5Tclose(material_type), H5Dclose(materials);
  EXPECT_EQ(raw_extent(file, "/material_image"), (std::vector<hsize_t>{5, 7}));
  const std::vector<double> image = raw_values(file, "/material_image"), objects = raw_values(file, "/instance_image");
  EXPECT_EQ(image[12], named.contributors.material[36]);
  EXPECT_EQ(image[34], 65535);
  EXPECT_GT(objects[12], 0);
  EXPECT_EQ(objects[34], 0);
  EXPECT_EQ(raw_extent(file, "/material_names"), (std::vector<hsize_t>{3}));
}

TEST(ContributorFile, has_the_same_bytes_a_day_later_and_whatever_memory_held_before) {
  expect_same_bytes_a_day_later([named = make_contributors()](const std::string& name) { return write(named, name); });
}

TEST(ContributorFile, names_the_dataset_that_is_missing) {
  for (const char* name : {"/surfel", "/id", "/share", "/elevation", "/material", "/path", "/material_names"}) {
    const std::string path = write(make_contributors());
    { EXPECT_GE(H5Ldelete(RawFile(path), name, H5P_DEFAULT), 0); }
    EXPECT_EQ(error_of_contributors(path), "content: c.h5: dataset " + std::string(name) + " is missing");
  }
}

TEST(ContributorFile, of_another_schema_names_both_versions) {
  const std::string path = write(make_contributors());
  raw_set(RawFile(path), "schema", 7);
  EXPECT_EQ(error_of_contributors(path), "content: c.h5: has contributor schema 7, this version reads schema 1");
}

TEST(ContributorFile, that_contradicts_itself_is_refused) {
  const std::string path = write(make_contributors());
  {
    const RawFile file(path);
    H5Ldelete(file, "/share", H5P_DEFAULT);
    H5Lcreate_hard(file, "/material_image", file, "/share", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(error_of_contributors(path), "content: c.h5: /share has 2 dimensions, must have 3");
  const std::string other = write(make_contributors());
  raw_overwrite(RawFile(other), "/path", std::vector<double>(105, 9));
  EXPECT_EQ(error_of_contributors(other), "content: c.h5: /path holds 9, must be 0, 1, 2 or 3");
}

TEST(ContributorFile, foreign_missing_and_truncated_files_are_refused) {
  const std::string text = own_file("text.h5", "this is not HDF5\n");
  EXPECT_EQ(error_with_kind([&] { read_contributor_file(text); }), "content: " + text + ": is not an HDF5 file");
  const std::string missing = own_path("missing.h5");
  EXPECT_EQ(error_with_kind([&] { read_contributor_file(missing); }),
            "file: " + missing + ": no such file; check the path");
  const std::string foreign = own_path("foreign.h5");
  H5Fclose(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_EQ(
      error_with_kind([&] { read_contributor_file(foreign); }),
      "content: " + foreign + ": is not a contributor file of insonify: attribute 'content' is not \"contributors\"");
  const std::string whole = read_text_file(write(make_contributors()));
  const std::string cut = own_file("cut.h5", whole.substr(0, whole.size() / 2));
  EXPECT_NE(error_with_kind([&] { read_contributor_file(cut); }).find(cut + ": is damaged or cut short"),
            std::string::npos);
}

TEST(ContributorFile, of_contributors_that_do_not_fit_is_not_written) {
  const std::string old = own_file("old.h5", "old");
  NamedContributors named = make_contributors();
  named.contributors.share.pop_back();
  EXPECT_EQ(error_with_kind([&] { write_to(old, named); }),
            "argument: ContributorFile: an array of the contributors has 104 entries, must have 5 beams x 7 bins x 3");
  named = make_contributors();
  named.materials.pop_back();
  EXPECT_EQ(error_with_kind([&] { write_to(old, named); }),
            "argument: ContributorFile: " + old + ": material 2 has no name, there are 2");
  EXPECT_EQ(read_text_file(old), "old");
}
