// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace insonify {

/// SHA-256 (FIPS 180-4) of bytes that are added piece by piece, by OpenSSL.
class Sha256 {
 public:
  /// Begins with no bytes.
  Sha256();
  /// Adds bytes after those added before.
  void add(std::string_view bytes);
  /// Returns the digest of all added bytes in 64 hexadecimal digits. Call it once, last.
  std::string digest();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// Returns the digest of `bytes` in 64 hexadecimal digits.
std::string sha256_of(std::string_view bytes);

/// Returns the digest of a file's content. Throws Error(file) if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace insonify
