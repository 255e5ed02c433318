// contct-replay: `contct replay` as a program of its own, without LAPACK and finite elements.
#include <exception>

#include "app/commands.hpp"
#include "app/streams.hpp"

namespace {

using contct::app::exit_status;

exit_status status_of_replay(int argc, char** argv) {
  try {
    const contct::app::command_options asked = contct::app::parse_contct_replay(argc, argv);
    const auto* options = std::get_if<contct::app::replay_options>(&asked);
    if (options != nullptr) return contct::app::run_command(*options);
    return contct::app::run_command(std::get<contct::app::printed_text>(asked));
  } catch (const std::exception& e) {
    contct::app::complain("{}", e.what());
  }
  return exit_status::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  contct::app::hold_standard_streams();
  return static_cast<int>(status_of_replay(argc, argv));
}
