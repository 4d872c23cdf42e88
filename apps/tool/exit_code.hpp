#pragma once
#include "core/error.hpp"

namespace insonify::tool {

/// The exit code of the programs for an error.
inline int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::runtime:
      return 1;
    case ErrorKind::argument:
      return 2;
    case ErrorKind::content:
      return 3;
    case ErrorKind::file:
      return 4;
  }
  return 1;
}

}  // namespace insonify::tool
