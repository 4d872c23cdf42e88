// SPDX-License-Identifier: BSD-3-Clause
#include "formats/npy_file.hpp"

#include <complex>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/input_file.hpp"

namespace insonify {
namespace {

const std::string npy_magic = "\x93NUMPY";

/// Returns the text after 'key': in the header, which is a Python dictionary.
std::string npy_value(const std::string& path, const std::string& header, const std::string& key, char end) {
  const std::size_t at = header.find("'" + key + "':");
  const std::size_t stop = at == header.npos ? at : header.find(end, at + key.size() + 3);
  if (stop == header.npos)
    fail(ErrorKind::content, path, ": its header has no ", key, ", so it is no .npy file of numpy");
  const std::size_t begin = at + key.size() + 3;
  return std::string(trimmed(std::string_view(header).substr(begin, stop - begin), " '("));
}

std::vector<std::size_t> npy_shape(const std::string& path, const std::string& text) {
  std::vector<std::size_t> shape;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::string_view number = trimmed(word);
    if (number.empty()) continue;
    std::size_t extent = 0;
    if (!to_number(number, extent)) fail(ErrorKind::content, path, ": shape (", text, ") is not one of whole numbers");
    shape.push_back(extent);
  }
  if (shape.size() != 2 || shape[0] == 0 || shape[1] == 0 || shape[0] > 1u << 24 || shape[1] > 1u << 24)
    fail(ErrorKind::content, path, ": has shape (", text,
         "), must have two dimensions, beams x bins, none of them 0; save one ping, e.g. a[0]");
  return shape;
}

template <typename Number>
Grid<double> npy_numbers(const char* bytes, const std::vector<std::size_t>& shape, bool fortran, std::size_t step) {
  Grid<double> grid(static_cast<Eigen::Index>(shape[0]), static_cast<Eigen::Index>(shape[1]));
  for (std::size_t i = 0; i < shape[0]; ++i)
    for (std::size_t j = 0; j < shape[1]; ++j) {
      Number number{};
      std::memcpy(&number, bytes + (fortran ? j * shape[0] + i : i * shape[1] + j) * step, sizeof number);
      grid(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = static_cast<double>(number);
    }
  return grid;
}

NpyArray npy_array(const std::string& path, const std::string& type, const char* bytes,
                   const std::vector<std::size_t>& shape, bool fortran) {
  if (type == "<f4") return {npy_numbers<float>(bytes, shape, fortran, 4)};
  if (type == "<f8") return {npy_numbers<double>(bytes, shape, fortran, 8)};
  if (type == "<c8")
    return {npy_numbers<float>(bytes, shape, fortran, 8), npy_numbers<float>(bytes + 4, shape, fortran, 8)};
  if (type == "<c16")
    return {npy_numbers<double>(bytes, shape, fortran, 16), npy_numbers<double>(bytes + 8, shape, fortran, 16)};
  if (type == "|u1") return {npy_numbers<std::uint8_t>(bytes, shape, fortran, 1), {}, 8};
  if (type == "<u2") return {npy_numbers<std::uint16_t>(bytes, shape, fortran, 2), {}, 16};
  if (type.starts_with('>'))
    fail(ErrorKind::content, path, ": holds big-endian numbers ('", type, "'), must be little-endian: save a.astype('<",
         type.substr(1), "')");
  fail(ErrorKind::content, path, ": holds numbers of type '", type,
       "', must be one of f4 f8 c8 c16 u1 u2: save e.g. a.astype('<f4')");
}

std::size_t npy_item_bytes(const std::string& type) {
  std::size_t bytes = 0;
  return type.size() > 2 && to_number(std::string_view(type).substr(2), bytes) ? bytes : 0;
}

}  // namespace

NpyArray read_npy(const std::string& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(ErrorKind::file, path, ": cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!bytes.starts_with(npy_magic)) fail(ErrorKind::content, path, ": does not begin as a .npy file of numpy does");
  const std::size_t lengths = bytes.size() > 6 && bytes[6] == 1 ? 2 : 4, begin = 8 + lengths;
  std::size_t length = 0;
  if (bytes.size() >= begin)
    for (std::size_t k = 0; k < lengths; ++k) length |= std::size_t{static_cast<std::uint8_t>(bytes[8 + k])} << (8 * k);
  if (bytes.size() < begin + length) fail(ErrorKind::content, path, ": ends within its header; the file is truncated");
  const std::string header = bytes.substr(begin, length);
  const std::string type = npy_value(path, header, "descr", ',');
  const bool fortran = npy_value(path, header, "fortran_order", ',') == "True";
  const std::vector<std::size_t> shape = npy_shape(path, npy_value(path, header, "shape", ')'));
  const std::size_t wanted = shape[0] * shape[1] * npy_item_bytes(type);
  if (const std::size_t there = bytes.size() - begin - length; there < wanted)
    fail(ErrorKind::content, path, ": has ", there, " bytes of numbers, must have ", wanted, " for ", shape[0], " x ",
         shape[1], " of '", type, "'; the file is truncated");
  return npy_array(path, type, bytes.data() + begin + length, shape, fortran);
}

}  // namespace insonify
