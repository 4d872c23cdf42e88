#include "sonar/water.hpp"
