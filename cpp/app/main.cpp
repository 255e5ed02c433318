// The contct program: one command a file, this one only chooses.
#include <fmt/format.h>

#include <exception>

#include "app/commands.hpp"
#include "contct/io/output_file.hpp"
#include "contct/io/toml_reader.hpp"

namespace {

constexpr const char* version = "contct " CONTCT_VERSION "\nlisting sha256 " CONTCT_LISTING_SHA256;

int run_program(int argc, char** argv) {
  contct::exit_status status = contct::exit_status::solved;
  CLI::App program("CONTCT: the 1989 contact subroutine, in FORTRAN and in C++, side by side.", "contct");
  program.set_version_flag("--version", version, "Print the version and the listing's checksum");
  program.require_subcommand(1);
  program.failure_message(CLI::FailureMessage::simple);
  contct::add_run(program, status);
  contct::add_kernels(program, status);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked_for_help = e.get_exit_code() == 0;
    program.exit(e);
    return asked_for_help ? 0 : static_cast<int>(contct::exit_status::bad_input);
  }
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "contct: {}\n", e.what());
    return static_cast<int>(contct::exit_status::bad_input);
  }
}
