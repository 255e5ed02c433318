// contct-replay: `contct replay` as a program of its own, without LAPACK and finite elements.
#include <exception>

#include "app/commands.hpp"
#include "app/streams.hpp"

namespace {

using contct::exit_status;

exit_status status_of_replay(int argc, char** argv) {
  try {
    const contct::command_options asked = contct::parse_contct_replay(argc, argv);
    const auto* options = std::get_if<contct::replay_options>(&asked);
    if (options != nullptr) return contct::run_command(*options);
    return contct::run_command(std::get<contct::printed_text>(asked));
  } catch (const std::exception& e) {
    contct::complain("{}", e.what());
  }
  return exit_status::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  contct::hold_standard_streams();
  return static_cast<int>(status_of_replay(argc, argv));
}
