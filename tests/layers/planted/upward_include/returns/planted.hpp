#include "compare/image_shift.hpp"
