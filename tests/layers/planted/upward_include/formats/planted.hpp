#include "store/cube.hpp"
