#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace insonify {

/// SHA-256 (FIPS 180-4) of bytes that are added piece by piece.
class Sha256 {
 public:
  /// Adds bytes after those added before.
  void add(std::string_view bytes);
  /// The digest of all that was added, in 64 hexadecimal digits. Call it once, last.
  std::string digest();

 private:
  void take_block(const char* block);
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> rest_{};
  std::uint64_t length_ = 0;
};

/// Returns the digest of `bytes` in 64 hexadecimal digits.
std::string sha256_of(std::string_view bytes);

/// The digest of a file's content. Throws Error(file) if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace insonify
