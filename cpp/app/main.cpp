// The contct program.
#include <csignal>
#include <cstdio>
#include <system_error>

#include "app/outputs.hpp"
#include "contct/solve/engine.hpp"

namespace contct::app {
namespace {

exit_status status_of_program(int argc, char** argv) {
  try {
    const command_options asked = parse_contct(argc, argv, engine_names());
    const exit_status status = std::visit([](const auto& options) { return run_command(options); }, asked);
    flush_standard_output();
    return status;
  } catch (const reader_gone&) {  // "contct run .. | head" ends as any filter does, its files written
    (void)std::signal(SIGPIPE, SIG_DFL);
    (void)std::raise(SIGPIPE);
  } catch (const kernel_failure& e) {
    complain("the leading kernel gave no answer: {}", e.what());
    return exit_status::kernels_differ;
  } catch (const std::system_error& e) {
    complain("{}{}", std::ferror(stdout) != 0 ? "standard output: " : "", e.what());
  } catch (const std::exception& e) {
    complain("{}", e.what());
  }
  return exit_status::bad_input;
}

}  // namespace
}  // namespace contct::app

int main(int argc, char** argv) {
  contct::app::hold_standard_streams();
  (void)std::signal(SIGPIPE, SIG_IGN);
  return static_cast<int>(contct::app::status_of_program(argc, argv));
}
