#include "returns/ping.hpp"
