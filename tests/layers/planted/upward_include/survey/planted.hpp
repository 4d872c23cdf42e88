#include "accuracy/accuracy_task.hpp"
