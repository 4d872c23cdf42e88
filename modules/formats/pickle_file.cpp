// SPDX-License-Identifier: BSD-3-Clause
#include "formats/pickle_file.hpp"

#include <cstdint>
#include <limits>
#include <string_view>

#include "core/error.hpp"
#include "files/pending_file.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

/// Opcodes of the pickle machine, as Python's pickletools names them.
struct PickleOp {
  static constexpr char empty_dict = '}', unicode = 'X', global = 'c', small_int = 'K', int_32 = 'J', none = 'N',
                        mark = '(', tuple = 't', tuple_1 = '\x85', tuple_2 = '\x86', tuple_3 = '\x87', yes = '\x88',
                        no = '\x89', reduce = 'R', build = 'b', set_item = 's', bytes_32 = 'B', stop = '.';
};

void pickle_text(std::string& out, std::string_view text) {
  out += PickleOp::unicode;
  put_little(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

void pickle_global(std::string& out, std::string_view module, std::string_view name) {
  out += PickleOp::global;
  out.append(module).append("\n").append(name).append("\n");
}

void pickle_int(std::string& out, std::int32_t number) {
  out += PickleOp::int_32;
  put_little(out, number);
}

void pickle_bytes(std::string& out, std::string_view bytes) {
  out += PickleOp::bytes_32;
  put_little(out, static_cast<std::uint32_t>(bytes.size()));
  out += bytes;
}

/// Appends numpy.dtype(type, False, True) with the state of a little-endian number.
void pickle_type(std::string& out, const std::string& type) {
  pickle_global(out, "numpy", "dtype");
  pickle_text(out, type);
  out += {PickleOp::no, PickleOp::yes, PickleOp::tuple_3, PickleOp::reduce, PickleOp::mark, PickleOp::small_int, '\3'};
  pickle_text(out, "<");
  out += {PickleOp::none, PickleOp::none, PickleOp::none};
  pickle_int(out, -1);
  pickle_int(out, -1);
  out += {PickleOp::small_int, '\0', PickleOp::tuple, PickleOp::build};
}

/// Appends an array as numpy pickles its own: an empty one, and its state.
void pickle_array(std::string& out, const NamedArray& array) {
  pickle_global(out, "numpy.core.multiarray", "_reconstruct");
  pickle_global(out, "numpy", "ndarray");
  out += {PickleOp::small_int, '\0', PickleOp::tuple_1};
  pickle_bytes(out, "b");
  out += {PickleOp::tuple_3, PickleOp::reduce, PickleOp::mark, PickleOp::small_int, '\1'};
  pickle_int(out, static_cast<std::int32_t>(array.rows));
  pickle_int(out, static_cast<std::int32_t>(array.columns));
  out += PickleOp::tuple_2;
  pickle_type(out, array.type);
  out += PickleOp::no;  // not in the order of Fortran
  pickle_bytes(out, array.bytes);
  out += {PickleOp::tuple, PickleOp::build};
}

template <typename Values>
std::string array_bytes(const Values& values) {
  return {reinterpret_cast<const char*>(values.data()),
          static_cast<std::size_t>(values.size()) * sizeof(typename Values::Scalar)};
}

}  // namespace

NamedArray named_array(const std::string& name, const Grid<float>& values) {
  return {name, "f4", values.rows(), values.cols(), array_bytes(values)};
}

NamedArray named_array(const std::string& name, const Eigen::Matrix4d& values) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = values;
  return {name, "f8", 4, 4, array_bytes(rows)};
}

void write_pickle(const std::string& path, const std::vector<NamedArray>& arrays) {
  std::string out = "\x80\3";
  out += PickleOp::empty_dict;
  for (const NamedArray& array : arrays) {
    if (array.bytes.size() > std::numeric_limits<std::uint32_t>::max())
      fail(ErrorKind::argument, "write_pickle: array '", array.name, "' has ", array.bytes.size(),
           " bytes, must have less than 4 GiB");
    pickle_text(out, array.name);
    pickle_array(out, array);
    out += PickleOp::set_item;
  }
  out += PickleOp::stop;
  write_file(path, out);
}

}  // namespace insonify
