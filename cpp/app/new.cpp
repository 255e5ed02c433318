// contct new: a commented problem file to start from.
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "app/commands.hpp"
#include "contct/text/did_you_mean.hpp"
#include "contct/text/output_file.hpp"

namespace contct::app {
namespace {

// Problems to start from, with every key explained.

constexpr const char* new_beam = R"(# A beam over two one-sided supports. Change the numbers, then:
#     contct run FILE
# Deflections, faces and forces are positive up; use one system of units throughout. Nodes count from 1.

title = "My beam"

[beam]
length   = 4.0          # or node coordinates, as many as you like: x = [0.0, 1.0, 2.5]
elements = 8            # as many elements of equal length: nodes 1 to 9
EI       = 1.0e4        # bending stiffness, one value or one per element

[[support]]             # permanent, and working both ways
node = 1                # or nodes = [1, 9], "2..4", "all"
fix  = ["w", "theta"]   # w is the deflection, theta the slope dw/dx
# spring = { w = 2.0e3 }  # elastic instead of fixed

[[contact]]             # a one-sided support; one block for each, numbered in this order
node      = 5
surface   = "below"     # the face stands below the beam; or "above"
face      = -0.010      # where it stands; 0 touches from the start
stiffness = 5.0e4       # of its spring; large is hard

[[contact]]
node      = 9
surface   = "below"
face      = -0.030
stiffness = 5.0e4

# [[bed]]               # a one-sided spring under every node, for ground that cannot pull
# modulus = 2.0e3       # force per length and deflection
# face    = -0.050

[[step]]                # loads are totals at the end of the step, reached proportionally from those before
uniform = -8.0          # force per length
point   = [ { node = 9, w = -20.0 } ]  # w is a force, theta a moment

[[step]]                # a second step: the point load is taken off again
uniform = -8.0
)";

constexpr const char* new_plate =
    R"(# A plate on ground that cannot pull, with a stop above. Change the numbers, then:
#     contct run FILE
# Deflections, faces and forces are positive up; use one system of units throughout.

title = "My plate"

[plate]
size      = [2.0, 1.0]  # or the grid lines: x = [0.0, 0.5, 2.0], y = [0.0, 1.0]
elements  = [8, 4]      # node of grid point (i, j), both from 0: j * 9 + i + 1, so 45 nodes
E         = 2.1e11      # E, nu and thickness; or D and nu
nu        = 0.3
thickness = 0.01

# [[support]]           # permanent, and working both ways: w, and the slopes wx = dw/dx and wy = dw/dy
# nodes = [1, 9, 37, 45]
# fix   = ["w"]

[[bed]]                 # a one-sided spring under every node: the modulus times its share of the area
modulus = 1.0e6         # force per area and deflection
face    = 0.0

[[contact]]             # one more pair: the stop
node      = 45          # the far corner
surface   = "above"
face      = 0.001       # above the plate, so at least 0
stiffness = 1.0e6

[[step]]                # loads are totals at the end of the step, reached proportionally from those before
uniform = -770.0        # pressure: the plate's own weight

[[step]]
uniform = -770.0
point   = [ { node = 1, w = -4000.0 } ]  # a force at the near corner: the far one lifts off
)";

const char* problem_of(const std::string& shape) {
  if (shape == "beam") return new_beam;
  if (shape == "plate") return new_plate;
  const std::vector<std::string> known = {"beam", "plate"};
  throw std::invalid_argument("SHAPE: found " + shape + did_you_mean(shape, known) +
                              "; allowed: beam or plate");
}

/// A name that is taken, if only by a link that leads nowhere, is never written to.
void refuse_taken(const std::string& file) {
  std::error_code ignored;
  const auto kind = std::filesystem::symlink_status(file, ignored).type();
  if (kind == std::filesystem::file_type::not_found || kind == std::filesystem::file_type::none) return;
  throw std::invalid_argument("FILE: found " + file +
                              ", which is there already; allowed: a new name, or - for standard output");
}

}  // namespace

exit_status run_command(const new_options& options) {
  const char* const text = problem_of(options.shape);
  const std::string file = options.file.empty() ? options.shape + ".toml" : options.file;
  if (file != "-") refuse_taken(file);
  output_file out(file);
  out.write(text);
  out.finish();
  if (file != "-") fmt::print("{} is written; now: contct run {}\n", file, file);
  return exit_status::solved;
}

}  // namespace contct::app
