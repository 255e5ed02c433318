// Where the 1989 code goes wrong, measured: kernels on random problems, cell by cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contct/lab/random_problem.hpp"
#include "contct/text/terminal.hpp"

namespace contct::lab {

/// EPSMUL as the listing prints it.
inline constexpr double printed_epsmul = .390625E-02;

/// EPSMUL of the 8-byte listing's variants, which differ in it alone, largest first; the printed one is not
/// among them. They are what the atlas measures, and no kernels that can be chosen.
[[nodiscard]] std::vector<double> epsmul_of_variants();

/// The variant of that index. It keeps no text.
[[nodiscard]] std::unique_ptr<kernel> make_epsmul_variant(std::size_t variant);

/// An answer is wrong when it is off by more than this share of the largest deflection. One measure
/// for all kernels: a 4-byte kernel rounds at 6e-8 and cannot meet the certificate's tolerance, which
/// is a matter of 8-byte rounding; 1e-3 is far from both, and more than an engineer would accept.
inline constexpr double wrong_beyond = 1e-3;

/// One kernel on random problems of one kind in one unit of length, and what came of them.
struct atlas_cell {
  std::string kernel;   ///< as contct knows it
  double epsmul = 0.0;  ///< of the listing, printed or replaced; 0 where the rule has none
  double unit = 1.0;    ///< of length
  bool held = true;     ///< by supports; otherwise by pairs alone

  int problems = 0;
  int wrong = 0;              ///< silently: a length is off by more than wrong_beyond, or a false equilibrium
  int false_equilibrium = 0;  ///< where there is none
  int false_mechanism = 0;    ///< the path stopped for one, and there is an equilibrium
  int never_held = 0;         ///< of these: nothing held the structure before the first increment
  int no_end = 0;             ///< the path stopped for a cycle, increments without end, or no factor
  int uncertified = 0;        ///< all that is not right to rounding in 8 bytes: the above, and more
  std::vector<double> errors = {};  ///< in deflections, of the wrong answers, sorted

  /// Count the result of one problem.
  void add(const problem_result& t);
  /// Add what came of other problems in the same cell.
  void add(const atlas_cell& part);
  /// The middle and the last of the errors; 0 when there is none.
  [[nodiscard]] double median_error() const { return errors.empty() ? 0.0 : errors[errors.size() / 2]; }
  [[nodiscard]] double worst_error() const { return errors.empty() ? 0.0 : errors.back(); }
  /// Is this the listing with another EPSMUL than printed?
  [[nodiscard]] bool has_other_epsmul() const { return epsmul != 0.0 && epsmul != printed_epsmul; }
};

/// The interval of a share with 95 % confidence (E. B. Wilson, 1927); it has a width for no hits at all, too.
struct confidence {
  double least, most;
};
[[nodiscard]] confidence wilson(int hits, int tried);

/// The units of length in which EPSMUL is varied: 1, and the one in which the listing's other
/// constant, EPSGAP, does least harm.
inline constexpr double epsmul_units[] = {1.0, 100.0};

/// All cells, empty: held structures first; `fortran`, `fortran-r4` and `corrected` in every unit, then
/// the listing with every other EPSMUL, in 8 bytes.
[[nodiscard]] std::vector<atlas_cell> atlas_cells();

struct atlas_request {
  int problems = 600;  ///< a cell
  std::uint64_t seed = 1;
};

/// What was asked for, and what came of it.
struct atlas {
  atlas_request request;
  std::vector<atlas_cell> cells;
};

/// Try the problems of a cell, numbers 0 and up of the seed: in every cell of a kind they are the same
/// problems in another unit.
void fill(atlas_cell& c, const atlas_request& r);

/// The same of all cells, in `jobs` processes (0: one for each processor); `tried` is told after some more
/// how many problems that were.
void fill(std::vector<atlas_cell>& cells, const atlas_request& r, int jobs,
          const std::function<void(std::int64_t more)>& tried = nullptr);

/// As CSV: a line a cell, and one of names before them.
[[nodiscard]] std::string atlas_csv(const atlas& a);

/// Format "contct-atlas-1": what was asked for, and the same numbers.
[[nodiscard]] std::string atlas_json(const atlas& a);

/// All cells as a table of 80 columns, and what its columns mean.
[[nodiscard]] std::string atlas_table(const atlas& a, const terminal& t);

}  // namespace contct::lab
