// contct prove: the prover is a Python package, which stands beside contct.py.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "app/commands.hpp"
#include "app/outputs.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

constexpr const char* python =
    "/usr/bin/python3";  // the one that Debian's packages of Capstone and Z3 are for

/// The folder of the Python package: in the build tree that of the program, else where contct.py is
/// installed.
fs::path folder_of_prover(const fs::path& program) {
  for (const char* from_here : {".", CONTCT_INSTALLED_PYTHON, "../lib/python3/dist-packages"}) {
    fs::path folder = (program.parent_path() / from_here).lexically_normal();
    if (fs::exists(folder / "contct_prove")) return folder;
  }
  throw std::runtime_error("the prover is not installed: found no contct_prove beside " + program.string() +
                           "; it comes with contct.py, in the package python3-contct");
}

}  // namespace

exit_status run_command(const prove_options& options) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const std::string folder = folder_of_prover(program);
  const std::string library = options.library.empty() ? program.string() : options.library;
  std::array<std::string, 7> words = {python, "-P",   "-m", "contct_prove", "--symbol=" + options.symbol,
                                      "--",   library};
  std::array<char*, words.size() + 1> arguments{};
  std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
  flush_standard_output();
  (void)setenv("PYTHONPATH", folder.c_str(), 1);
  execv(python, arguments.data());
  throw std::system_error(errno, std::generic_category(), std::string("cannot run ") + python);
}

}  // namespace contct
