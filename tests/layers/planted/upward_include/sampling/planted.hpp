#include "acoustics/echoes.hpp"
