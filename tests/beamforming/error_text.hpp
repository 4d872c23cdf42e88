#pragma once
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"

/// The text of the argument error that a call throws, or "no error".
inline std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const insonify::Error& error) {
    EXPECT_EQ(error.kind(), insonify::ErrorKind::argument);
    return error.what();
  }
  return "no error";
}
