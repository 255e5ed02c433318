// contct-replay: `contct replay` as a separate program, without LAPACK and finite elements.
#include "app/outputs.hpp"

int main(int argc, char** argv) {
  return contct::run_program([argc, argv] {
    const contct::command_options asked = contct::parse_contct_replay(argc, argv);
    if (const auto* options = std::get_if<contct::replay_options>(&asked)) return run_command(*options);
    return run_command(std::get<contct::printed_text>(asked));
  });
}
