// The contct program.
#include <csignal>
#include <cstdio>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "app/job.hpp"
#include "app/outputs.hpp"
#include "app/problem_runs.hpp"
#include "contct/number/rational.hpp"

namespace contct {
namespace {

/// Nothing where the command line has no meaning, which is said.
std::optional<command_options> asked_by(int argc, char** argv) {
  try {
    return parse_contct(argc, argv, engine_choices());
  } catch (const std::invalid_argument& e) {
    complain("{}", e.what());  // lines
  }
  return {};
}

exit_status status_of_program(int argc, char** argv) {
  try {
    if (!runs_the_program({argv, argv + argc})) return exit_status::solved;
    const std::optional<command_options> asked = asked_by(argc, argv);
    if (!asked) return exit_status::bad_input;
    const exit_status status = std::visit([](const auto& options) { return run_command(options); }, *asked);
    flush_standard_output();
    return status;
  } catch (const reader_gone&) {  // "contct run .. | head" ends as any filter does, its files written
    leave_job();
    (void)std::signal(SIGPIPE, SIG_DFL);
    (void)std::raise(SIGPIPE);
  } catch (const kernel_failure& e) {
    complain("the leading kernel gave no answer: {}", whole_line(e.what()));
    return exit_status::kernels_differ;
  } catch (const std::system_error& e) {
    complain("{}{}", std::ferror(stdout) != 0 ? "standard output: " : "", whole_line(e.what()));
  } catch (const std::bad_alloc&) {
    end_for_memory();
  } catch (const std::exception& e) {
    complain("{}", whole_line(e.what()));
  }
  return exit_status::bad_input;
}

}  // namespace
}  // namespace contct

int main(int argc, char** argv) {
  std::set_new_handler(contct::end_for_memory);
  contct::allocate_as_new_does();
  contct::hold_standard_streams();
  (void)std::signal(SIGPIPE, SIG_IGN);
  const contct::exit_status status = contct::status_of_program(argc, argv);
  contct::leave_job();
  return static_cast<int>(status);
}
