// The contct program: one command a file, this one only chooses.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <system_error>

#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/examples.hpp"
#include "app/manual.hpp"
#include "app/streams.hpp"
#include "app/usage.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/text/output_file.hpp"

namespace {

constexpr const char* version = "contct " CONTCT_VERSION "\nlisting sha256 " CONTCT_LISTING_SHA256;

contct::exit_status run_program(int argc, char** argv) {
  contct::exit_status status = contct::exit_status::solved;
  CLI::App program("CONTCT: the 1989 contact subroutine, in FORTRAN and in C++, side by side.", "contct");
  program.set_version_flag("--version", version, "Print the version and the listing's checksum");
  program.require_subcommand(1);
  contct::add_run(program, status);
  contct::add_explain(program, status);
  contct::add_new(program, status);
  contct::add_verify(program, status);
  contct::add_fuzz(program, status);
  contct::add_replay(program, status);
  contct::add_atlas(program, status);
  contct::add_export(program, status);
  contct::add_kernels(program, status);
  contct::add_completion(program);
  contct::add_man(program);
  contct::add_examples(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked_for_help = e.get_exit_code() == 0;
    if (!asked_for_help) {
      contct::complain("{}\nRun with --help for more information.", contct::usage_words(program, e));
      return contct::exit_status::bad_input;
    }
    program.exit(e);
  }
  contct::flush_standard_output();
  return status;
}

int status_of_run(int argc, char** argv) {
  try {
    return static_cast<int>(run_program(argc, argv));
  } catch (const contct::kernel_failure& e) {
    contct::complain("the leading kernel gave no answer: {}", e.what());
    return static_cast<int>(contct::exit_status::kernels_differ);
  } catch (const std::system_error& e) {
    const bool printing = std::ferror(stdout) != 0;
    contct::complain("{}{}", printing ? "standard output: " : "", e.what());
  } catch (const std::exception& e) {
    contct::complain("{}", e.what());
  }
  return static_cast<int>(contct::exit_status::bad_input);
}

}  // namespace

int main(int argc, char** argv) {
  contct::hold_standard_streams();
  return status_of_run(argc, argv);
}
