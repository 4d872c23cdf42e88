// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "formats/mcap_compression_internal.hpp"

#ifdef INSONIFY_LZ4
#include <lz4frame.h>
#endif
#ifdef INSONIFY_ZSTD
#include <zstd.h>
#endif

namespace insonify {
namespace {

#ifdef INSONIFY_LZ4
std::string lz4_frame(std::string_view bytes) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.contentSize = bytes.size();
  std::string frame(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  const std::size_t size = LZ4F_compressFrame(frame.data(), frame.size(), bytes.data(), bytes.size(), &preferences);
  if (LZ4F_isError(size)) fail(ErrorKind::runtime, "MCAP: lz4 failed: ", LZ4F_getErrorName(size));
  frame.resize(size);
  return frame;
}
#endif

#ifdef INSONIFY_ZSTD
std::string zstd_frame(std::string_view bytes) {
  constexpr int level = 3;  // zstd's own default
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size)) fail(ErrorKind::runtime, "MCAP: zstd failed: ", ZSTD_getErrorName(size));
  frame.resize(size);
  return frame;
}
#endif

}  // namespace

std::string_view mcap_compression_name(McapCompression compression) {
  constexpr std::string_view names[] = {"", "lz4", "zstd"};
  return names[static_cast<std::size_t>(compression)];
}

bool has_compression(McapCompression compression) {
#ifdef INSONIFY_LZ4
  if (compression == McapCompression::lz4) return true;
#endif
#ifdef INSONIFY_ZSTD
  if (compression == McapCompression::zstd) return true;
#endif
  return compression == McapCompression::none;
}

std::string compressed(McapCompression compression, std::string_view bytes) {
#ifdef INSONIFY_LZ4
  if (compression == McapCompression::lz4) return lz4_frame(bytes);
#endif
#ifdef INSONIFY_ZSTD
  if (compression == McapCompression::zstd) return zstd_frame(bytes);
#endif
  if (compression != McapCompression::none)
    fail(ErrorKind::argument, "MCAP: compression = ", mcap_compression_name(compression),
         ", whose library this build does not have");
  return std::string(bytes);
}

}  // namespace insonify
