// SPDX-License-Identifier: BSD-3-Clause
#include "support/errors.hpp"

#include <gmock/gmock.h>

#include "support/files.hpp"

namespace insonify {

std::string error_of(const std::function<void()>& call, ErrorKind kind) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(kind)) << error.what();
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not an insonify::Error: " << error.what();
  }
  return "no error";
}

std::string error_with_kind(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    const char* kinds[] = {"runtime", "argument", "content", "file", "memory"};
    return std::string(kinds[static_cast<int>(error.kind())]) + ": " + error.what();
  }
  return "no error";
}

std::string error_of_file(const std::function<void(const std::string&)>& load, const std::string& name,
                          const std::string& bytes) {
  const std::string path = own_file(name, bytes);
  return replaced(error_with_kind([&] { load(path); }), path, name);
}

void expect_error(ErrorKind kind, const std::vector<std::string>& parts, const std::function<void()>& call) {
  const std::string text = error_of(call, kind);
  EXPECT_NE(text, "no error") << "instead of '" << parts.front() << "'";
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  for (const std::string& part : parts) EXPECT_THAT(text, ::testing::HasSubstr(part));
}

}  // namespace insonify
