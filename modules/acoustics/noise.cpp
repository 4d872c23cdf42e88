#include "acoustics/noise.hpp"

#include <cmath>

#include "core/units.hpp"

namespace insonify {

double thermal_noise_level_db(const Pulse& pulse) {
  return -15 + 20 * std::log10(pulse.centre_frequency * 1e-3) + db_from_power(pulse.bandwidth);  // (E18)
}

}  // namespace insonify
