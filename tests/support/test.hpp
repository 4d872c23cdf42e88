// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The headers that nearly every test includes, precompiled (tests/CMakeLists.txt).
#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.hpp"
#include "support/errors.hpp"
#include "support/files.hpp"

using namespace insonify;  // only in tests, each of which would have this line
using testing::HasSubstr;
