#include "acoustics/water.hpp"
