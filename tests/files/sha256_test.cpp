// SPDX-License-Identifier: BSD-3-Clause
#include "files/sha256.hpp"

#include "support/test.hpp"

// Vectors of FIPS 180-4 and of NIST's examples.
TEST(Sha256, gives_the_digests_of_the_standard) {
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, does_not_depend_on_the_pieces_and_reads_files) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += static_cast<char>(i);
  for (const std::size_t piece : {1, 55, 56, 63, 64, 65}) {
    Sha256 sha;
    for (std::size_t at = 0; at < text.size(); at += piece) sha.add(std::string_view(text).substr(at, piece));
    EXPECT_EQ(sha.digest(), sha256_of(text)) << piece;
  }
  EXPECT_EQ(sha256_of_file(own_file("bytes", text)), sha256_of(text));
  EXPECT_THAT(error_of([] { sha256_of_file(own_path("none")); }, ErrorKind::file), HasSubstr("none: cannot be read"));
}
