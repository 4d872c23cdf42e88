#include "beamforming/synthesize.hpp"
