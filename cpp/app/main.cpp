// The contct program.
#include <cstdio>
#include <exception>
#include <system_error>

#include "app/commands.hpp"
#include "app/streams.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/solve/engine.hpp"
#include "contct/text/output_file.hpp"

namespace {

using contct::app::exit_status;

exit_status run_program(int argc, char** argv) {
  const contct::app::command_options asked =
      contct::app::parse_contct(argc, argv, contct::app::engine_names());
  const exit_status status =
      std::visit([](const auto& options) { return contct::app::run_command(options); }, asked);
  contct::app::flush_standard_output();
  return status;
}

exit_status status_of_program(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const contct::app::kernel_failure& e) {
    contct::app::complain("the leading kernel gave no answer: {}", e.what());
    return exit_status::kernels_differ;
  } catch (const std::system_error& e) {
    const bool printing = std::ferror(stdout) != 0;
    contct::app::complain("{}{}", printing ? "standard output: " : "", e.what());
  } catch (const std::exception& e) {
    contct::app::complain("{}", e.what());
  }
  return exit_status::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  contct::app::hold_standard_streams();
  return static_cast<int>(status_of_program(argc, argv));
}
