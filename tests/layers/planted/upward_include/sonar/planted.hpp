#include "scene/material.hpp"
