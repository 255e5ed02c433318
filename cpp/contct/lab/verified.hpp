// Every number of the verification table against what the codes give.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/lab/verification.hpp"

namespace contct {

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
  std::string failure;  ///< of the case as a whole, in words; empty when there is none

  [[nodiscard]] bool passed() const;
};

/// Run a problem twice, with FORTRAN leading C++ in lockstep and with the corrected kernel, and look at
/// each number: the corrected kernel must give its value, and so must FORTRAN unless the table says
/// what the 1989 rule gives instead. Not a bit may differ between FORTRAN and C++, and the corrected
/// kernel's states must be certified.
[[nodiscard]] verified_case verify_case(const verification_case& c, const problem& p);

/// What a number is, in a few words: "w, node 3", "pair 2 makes" (the share of the load at which it
/// does), "moment, element 4.1" (at its first end or corner).
[[nodiscard]] std::string quantity_words(const expected_number& e);

}  // namespace contct
