#include "core/deep/hidden_internal.hpp"
