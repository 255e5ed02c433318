// The numbers that the problems in reference/ are checked against, measured on the paths of the kernels, and
// judged.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/model/problem.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/session/run_result.hpp"
#include "contct/session/step_results.hpp"

namespace contct {

/// One number of reference/verification.toml, whose head explains the fields. Nodes, elements and
/// pairs count from 1, as in the file; 0 where a quantity does not need them.
struct expected_number {
  int step = 0;
  std::string quantity;
  int node = 0, pair = 0, element = 0;
  int place = 0;  ///< in the element: its end, 1 the left one, or its corner
  std::string dof, change, along;
  double from = 0.0;
  double value = 0.0;  ///< of a state: -1 in contact, +1 separated
  std::string kind, because, source;
  double tolerance = 0.0;          ///< relative; absolute for a value of 0
  std::optional<double> faithful;  ///< the value under the 1989 rule, if it differs
  std::string reason;              ///< why it does
  std::string exact;  ///< the exact number, "p/q" or a decimal; of a state, its name; empty: not known
};

/// The keys that identify a number of a problem, and their values in a table.
inline constexpr std::array<std::string_view, 11> place_keys = {
    "step", "quantity", "node", "pair", "element", "end", "corner", "dof", "change", "from", "along"};
[[nodiscard]] expected_number read_place(const toml_value& t);

/// The kind of number that gives the size of an error.
enum class kind_of_number { deflection, slope, force, moment, other };
[[nodiscard]] kind_of_number kind_of(const expected_number& e);

/// The double nearest to the exact number, which must be known; of a state as `value`.
[[nodiscard]] double exact_value(const expected_number& e);

/// One problem file and its numbers.
struct verification_case {
  std::string file;  ///< as written, relative to reference/problems
  std::vector<expected_number> checks;
};

/// Read the table. Throws input_error.
[[nodiscard]] std::vector<verification_case> read_verification(const std::string& path);

/// The description of a number: "w, node 3", "pair 2 makes" (the share of the load at which it does),
/// "moment, element 4.1" (at its first end or corner).
[[nodiscard]] std::string quantity_words(const expected_number& e);

/// The table's quantities, measured on a finished path.
class measurement {
 public:
  /// `p` and `path` must outlive this object.
  measurement(const problem& p, const run_recorder& path);

  /// The quantity on this path; NaN if the path did not reach it.
  [[nodiscard]] double of(const expected_number& e) const;

  /// The largest of its kind on the path, which errors are relative to: of deflections and gaps, slopes,
  /// forces and shears, or moments. Of shares of a load it is 1; of places and counts, which no certificate
  /// is about, 0.
  [[nodiscard]] double size_of(const expected_number& e) const;

 private:
  const problem& problem_;
  const run_recorder& path_;
  std::vector<step_results> read_;  // off the ends of steps
};

/// Is `measured` within the tolerance of `value`?
[[nodiscard]] bool agrees(double measured, double value, double tolerance);

/// The disagreement of one number with the exact one, in words; empty if they agree, or if the exact number
/// is unknown. `computed` lies within `allowed` of it, or within the table's own tolerance if `allowed` is 0.
/// The table's value is within its tolerance of it.
[[nodiscard]] std::string exact_disagreement(const expected_number& e, double computed, double allowed);

/// One number of the table, and the computed one.
struct verified_number {
  expected_number expected;
  double computed = 0.0;      ///< by FORTRAN, leading C++
  double corrected = 0.0;     ///< by the corrected kernel
  bool certified = false;     ///< the state of its step, on FORTRAN's path
  bool passed = false;        ///< see verify_case
  std::string apart;          ///< see exact_disagreement
  int exact_comparisons = 0;  ///< of `computed` and `corrected` with the exact number

  /// The difference of `computed` from the expected value, relative to it; absolute if it is 0.
  [[nodiscard]] double difference() const {
    const double off = computed - expected.value;
    return expected.value == 0.0 ? off : off / std::abs(expected.value);
  }
};

/// A problem file, and all its numbers.
struct verified_case {
  std::string file, title;
  std::vector<verified_number> numbers;
  std::vector<std::optional<certificate>> certificates;  ///< of the steps, on FORTRAN's path
  std::int64_t calls = 0, mismatches = 0;                ///< of the lockstep
  std::string failure;                                   ///< of the case as a whole; empty when there is none
};

/// Run a problem twice, with FORTRAN leading C++ in lockstep and with the corrected kernel, and look at
/// each number: the corrected kernel must give its value, and so must FORTRAN unless the table says
/// what the 1989 rule gives instead. Where they are certified, both must have the exact number as closely as
/// their certificates allow, which the table's numbers must agree with, too (see exact_disagreement). Not a
/// bit may differ between FORTRAN and C++, and the corrected kernel's states must be certified.
[[nodiscard]] verified_case verify_case(const verification_case& c, const problem& p);

}  // namespace contct
