// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "hdf/hdf5_internal.hpp"
#include "returns/ping_note.hpp"

// Private to store.
namespace insonify::hdf5 {

/// Names the dimensions of all datasets of a cube and makes ping, azimuth and range their scales (HDF5 dimension
/// scales, as h5py, netCDF and xarray know them).
void name_dimensions(const FileContext& context, hid_t file);

/// Returns true for an attribute that name_dimensions makes and that refers to other datasets of its file.
bool names_dimensions(const std::string& attribute);

}  // namespace insonify::hdf5
