// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "formats/gsf_fields_internal.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

/// Appends `value`, rounded. Throws Error(content) if a number of this type cannot hold it.
template <typename Number>
void put_rounded(std::string& bytes, double value, const char* name, const std::string& where) {
  const double rounded = std::nearbyint(value);
  if (!(rounded >= static_cast<double>(std::numeric_limits<Number>::lowest()) &&
        rounded <= static_cast<double>(std::numeric_limits<Number>::max())))
    fail(ErrorKind::content, "GSF: ", name, " of ", where, " is ", value, " in units of its field, must be within ",
         +std::numeric_limits<Number>::lowest(), " and ", +std::numeric_limits<Number>::max());
  put_big(bytes, static_cast<Number>(rounded));
}

}  // namespace

void put_gsf_number(std::string& bytes, GsfType type, double raw, const char* name, const std::string& where) {
  switch (type) {
    case GsfType::u8:
      return put_rounded<std::uint8_t>(bytes, raw, name, where);
    case GsfType::i16:
      return put_rounded<std::int16_t>(bytes, raw, name, where);
    case GsfType::u16:
      return put_rounded<std::uint16_t>(bytes, raw, name, where);
    case GsfType::i32:
      return put_rounded<std::int32_t>(bytes, raw, name, where);
    default:
      return put_rounded<std::uint32_t>(bytes, raw, name, where);
  }
}

void put_gsf_text(std::string& bytes, GsfType type, double size, const std::string& text) {
  if (type == GsfType::text16 || type == GsfType::text32) {
    const std::string kept = text.substr(0, 65534);
    if (type == GsfType::text16)
      put_big(bytes, static_cast<std::uint16_t>(kept.size() + 1));
    else
      put_big(bytes, static_cast<std::uint32_t>(kept.size() + 1));
    put_field(bytes, kept, kept.size() + 1);
  } else {
    put_field(bytes, text, static_cast<std::size_t>(size));
  }
}

}  // namespace insonify
