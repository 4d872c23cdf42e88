#include "simulate/ping_event.hpp"
