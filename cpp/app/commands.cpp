// The commands that need few lines: new, kernels, exact and prove.
#include "app/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/exact_output.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

// Problems to start from, with every key explained.

constexpr const char* new_beam = R"(# A beam over two one-sided supports. Change the numbers, then:
#     contct check FILE   # what it is, without solving it
#     contct run FILE
# Deflections, faces and forces are positive up.

title = "My beam"

[units]                 # labels for what is printed; all numbers must be in these units
length = "m"
force  = "kN"

[beam]
length       = 4.0      # or node coordinates: x = [0.0, 1.0, 2.5]
element_size = 0.5      # a node at every x that this file names, and no element longer than this
EI           = 1.0e4    # bending stiffness; or pieces: [ { to = 1.5, value = 1.0e4 }, { to = 4.0, value = 2.0e4 } ]

[[support]]             # permanent, and working both ways
x   = 0.0               # or several: x = [0.0, 4.0]; or by number from 1: node = 1, nodes = "1..3"
fix = ["w", "theta"]    # w is the deflection, theta the slope dw/dx
# spring = { w = 2.0e3 }  # elastic instead of fixed

[[contact]]             # one-sided supports, a pair at each x; pairs are numbered in this order
x         = [2.0, 4.0]
surface   = "below"     # the faces are below the beam; or "above"
face      = [-0.010, -0.030]  # where they are; 0 touches from the start. One value for all, or one for each
stiffness = 5.0e4       # of the pairs' springs; a large one is a hard stop

# [[bed]]               # a one-sided spring under every node, for ground that cannot pull
# modulus = 2.0e3       # force per length and deflection
# face    = -0.050

[[step]]                # loads are totals at the end of the step, reached proportionally from those before
name    = "load"
uniform = -8.0          # force per length
point   = [ { x = 4.0, w = -20.0 } ]  # w is a force, theta a moment
# settlement = [ { x = 0.0, w = -0.005 } ]  # moves a fixed dof: the total at the end of the step

[[step]]                # the point load is taken off again
name    = "unload"
uniform = -8.0
)";

constexpr const char* new_plate =
    R"(# A plate on ground that cannot pull, with a stop above. Change the numbers, then:
#     contct check FILE   # what it is, without solving it
#     contct run FILE
# Deflections, faces and forces are positive up.

title = "My plate"

[units]                 # labels for what is printed; all numbers must be in these units
length = "m"
force  = "N"

[plate]
size      = [2.0, 1.0]  # or the grid lines: x = [0.0, 0.5, 2.0], y = [0.0, 1.0]
elements  = [8, 4]      # node of grid point (i, j), both from 0: j * 9 + i + 1, so 45 nodes
E         = 2.1e11      # E, nu and thickness; or D and nu
nu        = 0.3
thickness = 0.01

# [[support]]           # permanent, and working both ways: w, and the slopes wx = dw/dx and wy = dw/dy
# at  = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [2.0, 1.0]]  # grid points; or nodes = [1, 9, 37, 45]
# fix = ["w"]

[[bed]]                 # a one-sided spring under every node: the modulus times its share of the area
modulus = 1.0e6         # force per area and deflection
face    = 0.0

[[contact]]             # one more pair: the stop
at        = [2.0, 1.0]  # the far corner
surface   = "above"
face      = 0.001       # above the plate, so at least 0
stiffness = 1.0e6

[[step]]                # loads are totals at the end of the step, reached proportionally from those before
name    = "weight"
uniform = -770.0        # pressure: the plate's own weight

[[step]]
name    = "corner load"
uniform = -770.0
point   = [ { at = [0.0, 0.0], w = -4000.0 } ]  # a force at the near corner: the far one lifts off
)";

const char* problem_of(const std::string& shape) {
  if (shape == "beam") return new_beam;
  if (shape == "plate") return new_plate;
  throw std::invalid_argument("SHAPE: found " + shape +
                              did_you_mean(shape, std::vector<std::string>{"beam", "plate"}) +
                              "; allowed: beam or plate");
}

/// A name that is taken, if only by a link that leads nowhere, is never written to.
void refuse_taken(const std::string& file) {
  std::error_code ignored;
  const auto kind = fs::symlink_status(file, ignored).type();
  if (kind == fs::file_type::not_found || kind == fs::file_type::none) return;
  throw std::invalid_argument("FILE: found " + file +
                              ", which exists already; allowed: a new name, or - for standard output");
}

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

/// A commented problem file to start from.
exit_status run_command(const new_options& options) {
  const char* const text = problem_of(options.shape);
  const std::string file = options.file.empty() ? options.shape + ".toml" : options.file;
  if (file != "-") refuse_taken(file);
  write_file(file, text);
  if (file != "-") print_text(fmt::format("{} is written; next: contct run {}\n", file, file));
  return exit_status::solved;
}

/// What is built in.
exit_status run_command(const kernels_options& /*options*/) {
  print_text(fmt::format("{:<12} {:<8} {:<9} {:<11} {}\n", "kernel", "REAL", "rule", "language", "compiler"));
  for (const std::string& name : kernel_names()) {
    const kernel_facts f = facts_of_kernel(name);
    print_text(fmt::format("{:<12} {} bytes  {:<9} {:<11} {}\n", f.name, f.real_bytes,
                           f.rule == contact_rule::listing ? "1989" : name_of(f.rule), f.language,
                           f.compiler));
  }
  print_text(
      fmt::format("\nexternal kernels: plugin:LIBRARY (a shared library), pipe:COMMAND (calls as text)\n"));
  print_text(fmt::format("listing sha256 {}\nfloating point: {}\n", CONTCT_LISTING_SHA256,
                         describe(probe_floating_point())));
  return exit_status::solved;
}

/// The path in rational arithmetic, and how many digits of each kernel are right.
exit_status run_command(const exact_options& options) {
  for (const std::string& name : options.kernels) (void)facts_of_kernel(name);
  const std::vector<output_option> outputs = {{"--json", options.json}};
  const problem p = read_with_warnings(options, outputs);
  const output_files files(outputs);
  progress path_shown(static_cast<std::int64_t>(p.steps.size()), "steps", options.quiet);
  const exact_progress tell = [&](int step, int increment, const rational& fraction) {
    path_shown.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", step,
                               p.steps.size(), increment, 100.0 * rounded(fraction)));
  };
  path_progress kernels_shown(p.steps.size(), options.quiet);
  const exact_run run = run_exactly(p, {options.file, options.rule, options.kernels}, tell, &kernels_shown);
  path_shown.erase();
  kernels_shown.line.erase();
  const exact_path& path = run.path;
  if (!options.quiet && !takes_standard_output(outputs))
    print_text(exact_text(run, options.digits, look_at_terminal()));
  flush_standard_output();
  if (output_file* const file = files["--json"]) write_exact_json(run, *file);
  if (path.status != path_status::solved)
    complain("{}: step {}, at share {} of its load: {}", whole_line(options.file), path.steps.size(),
             short_words(path.steps.back().fraction, options.digits),
             path.status == path_status::mechanism ? "no equilibrium"
             : path.status == path_status::path_ended
                 ? "the path of the 1989 rule ended: nothing held the structure"
                 : "the limit of increments is reached");
  return status_of(path.status);
}

/// The prover is a Python package, which stands beside contct.py.
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
