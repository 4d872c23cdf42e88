// SPDX-License-Identifier: BSD-3-Clause
#include "store/element_file.hpp"

#include "core/error.hpp"
#include "hdf/hdf5_internal.hpp"
#include "returns/ping.hpp"
#include "store/cube_layout_internal.hpp"

namespace insonify {

using namespace hdf5;

namespace {
constexpr std::int64_t element_schema = 1;
}

void write_element_file(const std::string& path, const ElementSeries& series, const SonarHead& head,
                        double sound_speed) {
  if (series.pressure.rows() != static_cast<Eigen::Index>(head.array.elements()) || series.pressure.cols() == 0)
    fail(ErrorKind::argument, "write_element_file: ", path, ": the series has ", series.pressure.rows(),
         " elements and ", series.pressure.cols(), " samples, must have ", head.array.elements(), " elements");
  const ComplexGridF pressure = stored_pressure(series.pressure, "write_element_file");
  write_hdf5(path, [&](const FileContext& context, hid_t file) {
    write_attribute(context, file, "schema", element_schema);
    write_attribute(context, file, "start", series.start);
    write_attribute(context, file, "step", series.step);
    write_attribute(context, file, "spacing", head.array.spacing);
    if (head.array_radius > 0) write_attribute(context, file, "radius", head.array_radius);
    write_attribute(context, file, "centre_frequency", head.pulse.centre_frequency);
    write_attribute(context, file, "sound_speed", sound_speed);
    write_attribute(context, file, "steering",
                    std::string(head.array_radius > 0 ? "exp(+2 pi i f (x ux + y uy) / c)" : "exp(+2 pi i f y u / c)"));
    const Extent extent = {static_cast<hsize_t>(pressure.rows()), static_cast<hsize_t>(pressure.cols())};
    const Handle dataset = create_dataset(context, file, pressure_name, complex_type(context, H5T_IEEE_F32LE), extent);
    write_attribute(context, dataset, convention_attribute, std::string(pressure_convention));
    context.checked(
        H5Dwrite(dataset, complex_type(context, H5T_NATIVE_FLOAT), H5S_ALL, H5S_ALL, H5P_DEFAULT, pressure.data()),
        pressure_name.path);
  });
}

}  // namespace insonify
