// Computes the numbers of reference/verification.toml on the paths of the kernels, and compares them with the
// expected values.
#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "contct/proof/certificate.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/results/run_result.hpp"
#include "contct/results/step_results.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// One number of reference/verification.toml. The comment at the beginning of verification.toml explains the
/// fields. Nodes, elements and pairs count from 1; they are 0 if the quantity does not need them.
struct expected_number {
  int step = 0;
  std::string quantity;
  int node = 0, pair = 0, element = 0;
  int place = 0;  ///< end (1: left) or corner of the element
  std::string dof, change, along;
  double from = 0.0;
  double value = 0.0;  ///< the expected value; for a state -1 in contact, +1 separated
  std::string kind, because, source;
  double tolerance = 0.0;          ///< relative; absolute for a value of 0
  std::optional<double> faithful;  ///< the value under the 1989 rule, if not `value`
  std::string reason;              ///< why `faithful` differs from `value`
  std::string exact;  ///< the exact number, "p/q" or a decimal; the name of a state; empty if unknown
};

struct verification_case {
  std::string file;  ///< name relative to reference/problems
  std::vector<expected_number> checks;
};

/// Reads verification.toml at `path`. Throws input_error.
[[nodiscard]] std::vector<verification_case> read_verification(const std::string& path);

/// Describes a number: "w, node 3"; "pair 2 makes", for the share of the step at which pair 2 makes; "moment,
/// element 4.1", for the first end or corner of element 4.
[[nodiscard]] std::string quantity_words(const expected_number& e);

/// Measures the table's quantities on a finished path.
class measurement {
 public:
  /// `p` and `path` must outlive this object.
  measurement(const problem& p, const run_recorder& path);

  /// The value of `e` on the path; NaN if the path has no such quantity, or ended before the step.
  [[nodiscard]] double of(const expected_number& e) const;

  /// The number to which errors of `e` are relative: the largest deflection, slope, force or moment of the
  /// path; 1 for a share of a step; 0 for places and counts, which certificates do not cover.
  [[nodiscard]] double size_of(const expected_number& e) const;

 private:
  const problem& problem_;
  const run_recorder& path_;
  std::deque<step_results> read_;  // results at the ends of the steps
};

/// True if `measured` differs from `value` by at most `tolerance`: relative, or absolute if `value` is 0.
[[nodiscard]] bool agrees(double measured, double value, double tolerance);

/// Describes how `computed`, or else the table's value, disagrees with the exact number; empty if `computed`
/// and the table's value agree with the exact number, or if no exact number is known. `computed` may differ
/// by `allowed`, or by the table's tolerance if `allowed` is 0. The table's value may differ by the table's
/// tolerance.
[[nodiscard]] std::string exact_disagreement(const expected_number& e, double computed, double allowed);

struct verified_number {
  expected_number expected;
  double computed = 0.0;      ///< FORTRAN's value, with C++ in lockstep
  double corrected = 0.0;     ///< the corrected kernel's value
  bool certified = false;     ///< the final state of `expected.step` on FORTRAN's path is certified
  bool passed = false;        ///< see verify_case
  std::string apart;          ///< see exact_disagreement
  int exact_comparisons = 0;  ///< number of comparisons with the exact number

  /// The difference of `computed` from the expected value: relative, or absolute if the expected value is 0.
  [[nodiscard]] double difference() const {
    const double off = computed - expected.value;
    return expected.value == 0.0 ? off : off / std::abs(expected.value);
  }
};

struct verified_case {
  std::string file, title;
  std::vector<verified_number> numbers;
  std::vector<solved_step> steps;          ///< of FORTRAN's path
  std::int64_t calls = 0, mismatches = 0;  ///< calls in lockstep, and differing values
  std::string failure;                     ///< a failure of the whole case, or empty
};

/// Runs a problem twice: with FORTRAN leading C++ in lockstep, and with the corrected kernel. The corrected
/// kernel must give the expected numbers, and its states must be certified. FORTRAN must give the expected
/// numbers or the table's `faithful` values, and must be equal to C++ to the bit. Certified results must be
/// as close to the exact number as a certificate promises, and the table's value must agree with the exact
/// number (see exact_disagreement).
[[nodiscard]] verified_case verify_case(const verification_case& c, const problem& p);

}  // namespace contct
