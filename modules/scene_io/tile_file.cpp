// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"
#include "scene_io/tile_file_internal.hpp"

namespace insonify {
namespace {

[[noreturn]] void fail_here(const std::string& path, const char* what) {
  fail(ErrorKind::file, path, ": cannot ", what, ": ", std::strerror(errno),
       "; check the folder, its permissions and the space on the disk");
}

int open_nameless(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  std::string name = (folder / ".insonify-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  // Without a name nothing can be left behind, however the program ends.
  if (descriptor >= 0) ::unlink(name.c_str());
  return descriptor;
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace

std::uint64_t checksum(std::span<const char> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}

std::string pack_materials(const std::vector<Material>& materials) {
  std::string bytes;
  const std::size_t numbers = numbers_said(materials);
  for (const Material& m : materials) {
    for (std::size_t k = 0; k < numbers; ++k) append(bytes, m.*material_numbers[k].member);
    append(bytes, static_cast<std::uint32_t>(m.name.size()));
    bytes += m.name;
  }
  if (!has_laws(materials)) return bytes;
  for (const Material& m : materials) {
    const std::string law = law_to_text(m.law);
    append(bytes, static_cast<std::uint32_t>(law.size()));
    bytes += law;
  }
  return bytes;
}

bool has_laws(const std::vector<Material>& materials) {
  return std::any_of(materials.begin(), materials.end(), [](auto& m) { return m.law != SurfaceLaw{}; });
}

std::vector<Material> unpack_materials(std::span<const char> bytes, const TileHeader& header, const std::string& path) {
  const auto require = [&](bool good) {
    if (!good) fail(ErrorKind::content, path, ": the material table is damaged; prepare the scene again");
  };
  const auto take = [&](auto& value) {
    require(bytes.size() >= sizeof(value));
    std::memcpy(&value, bytes.data(), sizeof(value));
    bytes = bytes.subspan(sizeof(value));
  };
  const std::size_t numbers = first_material_numbers + header.added_numbers;
  if (numbers > std::size(material_numbers))
    fail(ErrorKind::content, path, ": a material has ", numbers, " numbers, this insonify reads up to ",
         std::size(material_numbers), "; update insonify, or prepare the scene with this one");
  const auto take_text = [&] {
    std::uint32_t length = 0;
    take(length);
    require(bytes.size() >= length);
    const std::string text(bytes.data(), length);
    bytes = bytes.subspan(length);
    return text;
  };
  std::vector<Material> materials(header.materials <= bytes.size() ? header.materials : 0);
  require(materials.size() == header.materials);
  for (Material& m : materials) {
    for (std::size_t k = 0; k < numbers; ++k) take(m.*material_numbers[k].member);
    m.name = take_text();
  }
  if (header.flags & flag_laws)
    for (Material& m : materials) {
      const std::optional<SurfaceLaw> law = law_from_text(take_text());
      require(law && problem_of(*law).empty());
      m.law = *law;
    }
  require(bytes.empty());
  return materials;
}

BinaryFile::BinaryFile(const std::string& path, Mode mode) : path_(path) {
  if (mode == Mode::read) descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (mode == Mode::create) descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (mode == Mode::nameless) descriptor_ = open_nameless(path);
  if (descriptor_ < 0) fail_here(path, mode == Mode::read ? "be read" : "be written");
}

BinaryFile::~BinaryFile() { ::close(descriptor_); }

void BinaryFile::read(std::uint64_t offset, std::span<char> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_here(path_, "be read");
    if (got == 0)
      fail(ErrorKind::content, path_, ": cut off: expected ", bytes.size(), " bytes at byte ", offset, ", found ", done,
           "; copy or make the file again");
    done += static_cast<std::size_t>(got);
  }
}

void BinaryFile::write(std::uint64_t offset, std::span<const char> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto put = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail_here(path_, "be written");
    done += static_cast<std::size_t>(put);
  }
}

std::uint64_t BinaryFile::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail_here(path_, "be read");
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace insonify
