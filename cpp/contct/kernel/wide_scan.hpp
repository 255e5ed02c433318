// The scan of the pairs, several at a time: what the two rules in C++ have to do at every pair of a call, by
// the widest instructions that the processor has. Every width gives the bits of the plain loops.
#pragma once

#include <cstddef>
#include <span>

#include "contct/rooms.hpp"

namespace contct::kernels {

/// Where the dof of each pair is among the dofs of the structure.
enum class placing {
  side_by_side,  ///< dof, dof + 1, dof + 2, ..
  evenly,        ///< dof, dof + step, dof + 2 step, ..
  anyhow,        ///< by ID
};

/// The arrays of a call, for a scan of its pairs.
struct pair_arrays {
  const double* d;       ///< D [dofs]
  const double* d_star;  ///< d* [dofs]
  const double* c;       ///< faces [n]
  double* s;             ///< out: scale factors [n]
  const int* id;         ///< node of each pair, from 1 [n]
  const int* i_sep;      ///< [n]
  const int* i_surf;     ///< [n]
  std::size_t n;         ///< pairs
  std::ptrdiff_t step;   ///< NDOFPN
  std::ptrdiff_t dof_0;  ///< dof, from 0, of a pair at node 0
  placing placed;        ///< of all dofs
};

/// The least s of those that a scan looked at, and the first pair that has it.
struct least_s {
  double s;          ///< 1 where none is less
  std::size_t pair;  ///< n where none is less
};

/// The scan by one set of instructions. Each function looks at the first `whole(n)` pairs; the rest, fewer
/// than fit into one step, are the caller's.
struct wide_scan {
  const char* name;   ///< of the instructions
  std::size_t lanes;  ///< pairs that one instruction takes
  /// With fewer pairs the plain loops of the 1989 rule are as quick. SSE2 has no instruction that chooses
  /// between two numbers, and gains only where there are too many branches to be guessed.
  std::size_t many_pairs;
  /// Does ID count up by one from pair to pair? It looks at all pairs.
  bool (*counts_up)(const int* id, std::size_t n);
  /// The 1989 rule: sets s of each pair; the least s > 0. Its `pair` is not set.
  least_s (*listing)(const pair_arrays& a);
  /// The first pair from `from` on, n if none, that |s - s_min| <= bound lets through. It looks at all pairs.
  std::size_t (*near)(const double* s, std::size_t from, std::size_t n, double s_min, double bound);
  /// The corrected rule: the largest |d*|.
  double (*largest_response)(const pair_arrays& a);
  /// The corrected rule: sets s of each pair; a separated one that responds by no more than `quiet` has none.
  least_s (*corrected)(const pair_arrays& a, double quiet);

  /// How many of n pairs the scan looks at.
  [[nodiscard]] std::size_t whole(std::size_t n) const { return n - n % (2 * lanes); }
};

/// Those that this processor has, from two lanes, which any has, to the widest.
[[nodiscard]] std::span<const wide_scan> wide_scans();

/// The widest of them.
[[nodiscard]] const wide_scan& widest_scan();

}  // namespace contct::kernels
