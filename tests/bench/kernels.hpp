// One call of the listing against one of the C++ kernel, without the structure and without text; and both in
// lockstep.
#pragma once

#include <cstddef>

namespace bench {

/// Least seconds of a call in which nothing happens, so that every pair is looked at and none is toggled. The
/// listing writes a line even then: `fortran` is less what a call without pairs costs, which is that line.
/// The least of `rounds` rounds is taken.
struct seconds_of_a_call {
  double fortran;
  double cpp;
  double text;              ///< the listing's call without pairs
  double lockstep;          ///< both kernels' answers compared; the texts in blocks of calls
  double lockstep_on_path;  ///< the same with the text of each call compared by itself, as on a path
};
[[nodiscard]] seconds_of_a_call time_kernels(std::size_t pairs, int rounds);

}  // namespace bench
