// contct-replay: `contct replay` as a separate program, without LAPACK and finite elements.
#include <new>

#include "app/outputs.hpp"

namespace contct {
namespace {

exit_status status_of_replay(int argc, char** argv) {
  try {
    const command_options asked = parse_contct_replay(argc, argv);
    if (const auto* options = std::get_if<replay_options>(&asked)) return run_command(*options);
    return run_command(std::get<printed_text>(asked));
  } catch (const std::bad_alloc&) {
    end_for_memory();
  } catch (const std::exception& e) {
    complain("{}", e.what());
  }
  return exit_status::bad_input;
}

}  // namespace
}  // namespace contct

int main(int argc, char** argv) {
  std::set_new_handler(contct::end_for_memory);
  contct::hold_standard_streams();
  return static_cast<int>(contct::status_of_replay(argc, argv));
}
