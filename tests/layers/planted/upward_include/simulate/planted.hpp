#include "survey/mission.hpp"
