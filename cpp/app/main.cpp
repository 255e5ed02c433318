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

using contct::exit_status;

exit_status run_program(int argc, char** argv) {
  const contct::command_options asked = contct::parse_contct(argc, argv, contct::engine_names());
  const exit_status status =
      std::visit([](const auto& options) { return contct::run_command(options); }, asked);
  contct::flush_standard_output();
  return status;
}

exit_status status_of_program(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const contct::kernel_failure& e) {
    contct::complain("the leading kernel gave no answer: {}", e.what());
    return exit_status::kernels_differ;
  } catch (const std::system_error& e) {
    const bool printing = std::ferror(stdout) != 0;
    contct::complain("{}{}", printing ? "standard output: " : "", e.what());
  } catch (const std::exception& e) {
    contct::complain("{}", e.what());
  }
  return exit_status::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  contct::hold_standard_streams();
  return static_cast<int>(status_of_program(argc, argv));
}
