// contct-replay: `contct replay` as a program of its own, without LAPACK and finite elements.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "app/commands.hpp"
#include "app/streams.hpp"
#include "app/usage.hpp"

namespace {

int status_of_replay(int argc, char** argv) {
  contct::exit_status status = contct::exit_status::solved;
  CLI::App program("Put recorded calls of CONTCT to a kernel, and compare to the bit.", "contct-replay");
  program.set_version_flag("--version",
                           "contct-replay " CONTCT_VERSION "\nlisting sha256 " CONTCT_LISTING_SHA256,
                           "Print the version and the listing's checksum");
  contct::describe_replay(program, status);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);
    contct::complain("{}\nRun with --help for more information.", contct::usage_words(program, e));
    return static_cast<int>(contct::exit_status::bad_input);
  }
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  contct::hold_standard_streams();
  try {
    return status_of_replay(argc, argv);
  } catch (const std::exception& e) {
    contct::complain("{}", e.what());
  }
  return static_cast<int>(contct::exit_status::bad_input);
}
