// SPDX-License-Identifier: BSD-3-Clause
#include "files/sha256.hpp"

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include <openssl/evp.h>

#include "core/error.hpp"

namespace insonify {
namespace {

void require_done(int status) {
  if (status != 1) fail(ErrorKind::runtime, "SHA-256 failed within OpenSSL");
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  require_done(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
}

void Sha256::add(std::string_view bytes) { require_done(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size())); }

std::string Sha256::digest() {
  std::array<unsigned char, 32> sum{};
  require_done(EVP_DigestFinal_ex(context_.get(), sum.data(), nullptr));
  std::string hex;
  for (const unsigned char byte : sum) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

std::string sha256_of(std::string_view bytes) {
  Sha256 sha;
  sha.add(bytes);
  return sha.digest();
}

std::string sha256_of_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  Sha256 sha;
  std::vector<char> piece(1 << 16);
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    sha.add({piece.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof() || file.bad())
    fail(ErrorKind::file, path, ": cannot be read: ", std::generic_category().message(errno ? errno : EIO));
  return sha.digest();
}

}  // namespace insonify
