// The planted error: a numeric module opens a file.
#include "files/input_file.hpp"
