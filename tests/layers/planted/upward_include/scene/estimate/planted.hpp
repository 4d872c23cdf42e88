#include "sampling/scatterers.hpp"
