// One call of the listing against one of the C++ kernel, without the structure and without text.
#pragma once

#include <cstddef>

namespace bench {

/// Least seconds of a call in which nothing happens, so that every pair is looked at and none is toggled. The
/// listing writes a line even then: `fortran` is less what a call without pairs costs, which is that line.
/// The least of `rounds` rounds is taken.
struct seconds_of_a_call {
  double fortran;
  double cpp;
  double text;  ///< the listing's call without pairs
};
[[nodiscard]] seconds_of_a_call time_kernels(std::size_t pairs, int rounds);

}  // namespace bench
