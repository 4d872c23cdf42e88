// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace insonify {

/// Returns the text of the Error that `call` throws, which must be of `kind`; "no error" if it throws none.
std::string error_of(const std::function<void()>& call, ErrorKind kind = ErrorKind::argument);

/// Returns the Error of any kind as "kind: text", kind being runtime, argument, content or file.
std::string error_with_kind(const std::function<void()>& call);

/// Returns the error of `load` for a file of these bytes, as error_with_kind does, with `name` in place of its path.
std::string error_of_file(const std::function<void(const std::string& path)>& load, const std::string& name,
                          const std::string& bytes);

/// Expects an Error of `kind` from `call`, whose text is one line with all `parts`.
void expect_error(ErrorKind kind, const std::vector<std::string>& parts, const std::function<void()>& call);

}  // namespace insonify
