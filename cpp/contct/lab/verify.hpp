// Measures the numbers of the verification table on the paths of the kernels, and judges them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/free_run.hpp"
#include "contct/lab/verification_table.hpp"
#include "contct/path/observer.hpp"
#include "contct/structure/problem.hpp"

namespace contct::lab {

/// Observes a run and measures, afterwards, what the table asks for.
class measurement final : public observer {
 public:
  /// `p` must outlive this object.
  explicit measurement(const problem& p) : problem_(p) {}

  void incremented(const increment& i) override { path_.incremented(i); }
  void step_ended(const step_state& s) override;

  /// The quantity as this run has it; NaN when the run did not get there.
  [[nodiscard]] double of(const expected_number& e) const;

 private:
  struct step_record {
    std::vector<int> isep;
    element_results elements;
    std::vector<double> reactions;
  };
  /// D at the end of the number's step [dofs].
  [[nodiscard]] const std::vector<double>& u(const expected_number& e) const {
    return path_.displacement[e.step - 1];
  }
  [[nodiscard]] double of_element(const expected_number& e, std::size_t quantity) const;
  [[nodiscard]] double of_support(const expected_number& e) const;
  [[nodiscard]] double of_pair(const expected_number& e) const;
  [[nodiscard]] double of_events(const expected_number& e) const;
  [[nodiscard]] double zero_right_of(const expected_number& e) const;

  const problem& problem_;
  path_record path_;
  std::vector<step_record> steps_;
};

/// Is `measured` within the tolerance of `value`?
[[nodiscard]] bool agrees(double measured, double value, double tolerance);

/// One number of the table, and what came out.
struct verified_number {
  expected_number expected;
  double computed = 0.0;   ///< by FORTRAN, leading C++
  double corrected = 0.0;  ///< by the corrected kernel
  bool certified = false;  ///< the state of its step, on FORTRAN's path
  bool passed = false;     ///< see verify_case

  /// Of `computed` from the expected value; absolute where that is 0.
  [[nodiscard]] double difference() const;
};

/// A problem file, and all its numbers.
struct verified_case {
  std::string file, title;
  std::vector<verified_number> numbers;
  std::vector<std::optional<certificate>> certificates;  ///< of the steps, on FORTRAN's path
  std::int64_t calls = 0, mismatches = 0;                ///< of the lockstep
  std::string failure;                                   ///< of the case as a whole; empty when there is none

  [[nodiscard]] bool passed() const;
};

/// Run a problem twice, with FORTRAN leading C++ in lockstep and with the corrected kernel, and look at
/// each number: the corrected kernel must give its value, and so must FORTRAN unless the table says
/// what the 1989 rule gives instead. Not a bit may differ between FORTRAN and C++, and the corrected
/// kernel's states must be certified.
[[nodiscard]] verified_case verify_case(const verification_case& c, const problem& p);

}  // namespace contct::lab
