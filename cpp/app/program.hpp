// The contct program.
#pragma once

namespace contct {

/// Runs the program with the arguments of main. Returns its exit status.
[[nodiscard]] int run_contct(int argc, char** argv);

}  // namespace contct
