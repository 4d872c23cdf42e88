#include <cstdio>
#include <exception>
#include <new>

#include "tool/command_line.hpp"
#include "tool/exit_code.hpp"
#include "tool/progress.hpp"

int main(int argc, char** argv) {
  try {
    insonify::tool::catch_interrupts();
    return insonify::tool::run_command_line(argc, argv);
  } catch (const insonify::tool::Interrupted&) {
    std::fputs("insonify: interrupted; nothing was written\n", stderr);
    return 130;
  } catch (const insonify::Error& error) {
    std::fprintf(stderr, "insonify: %s\n", error.what());
    return insonify::tool::exit_code(error.kind());
  } catch (const std::bad_alloc&) {
    std::fputs("insonify: out of memory; use a smaller scene, fewer scatterers per cell or a shorter range\n", stderr);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "insonify: %s\n", error.what());
    return 1;
  }
}
