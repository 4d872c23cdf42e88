// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mutex>

namespace insonify {

/// The turn of a thread in a library that only one thread at a time may use; `Library` is its name. A thread that has
/// the turn may take it again. So may a child process that it starts, where no other thread could give it back.
template <typename Library>
class LibraryTurn {
 public:
  /// Waits until no other thread has the turn.
  LibraryTurn() : lock_(turn_) {}

 private:
  static inline std::recursive_mutex turn_;
  std::lock_guard<std::recursive_mutex> lock_;
};

/// The turn in VTK, with FreeType and EGL: fonts, texts, messages and contexts exist once per process. Whatever uses one
/// of them has it.
using VtkTurn = LibraryTurn<class Vtk>;

/// The turn in HDF5, also in GDAL where it reads rasters: its drivers of netCDF and BAG use HDF5, and its cache is one.
using Hdf5Turn = LibraryTurn<class Hdf5>;

}  // namespace insonify
