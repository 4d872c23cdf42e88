#include "tool/command/command_line.hpp"

int main(int argc, char** argv) { return insonify::tool::run_tool(argc, argv); }
