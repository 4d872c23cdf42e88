#include "core/hidden_internal.hpp"
