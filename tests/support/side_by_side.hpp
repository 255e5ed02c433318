// Compares the listing with the C++ kernel on the same calls, to the bit, and counts the compared values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contct/compare/branches.hpp"
#include "contct/compare/compare.hpp"
#include "contct/kernel/call.hpp"
#include "contct/kernel/fortran.hpp"

namespace contct {

/// Compares FORTRAN and C++ in one precision. SMIN, SS and ISEP are compared after each call. Unit 26 is
/// compared in blocks, because reading it after every call would take ten times as long. No other object may
/// use unit 26 during the lifetime of this object.
template <class Real>
class side_by_side {
 public:
  /// Passes one call to both kernels.
  void put(const call_inputs<Real>& in);

  /// Compares the text since the last comparison; must be called once more at the end.
  void compare_gathered_text();

  [[nodiscard]] std::int64_t calls() const { return calls_; }
  [[nodiscard]] const tally& compared() const { return tally_; }
  [[nodiscard]] const branch_counts& branches() const { return branches_; }
  /// Returns the first difference, such as "call 17: SS(3): 0x1p+0 against 0x1.8p+0".
  [[nodiscard]] const std::optional<std::string>& first_difference() const { return first_; }
  /// Returns FORTRAN's answer to the last call.
  [[nodiscard]] const std::vector<Real>& last_ss() const { return fortran_.ss; }
  [[nodiscard]] Real last_smin() const { return fortran_.smin; }

 private:
  struct outputs {
    Real smin;
    std::vector<Real> ss;
    std::vector<int> isep;
  };
  call<Real> prepare(const call_inputs<Real>& in, outputs& out) const;
  void note(const std::optional<mismatch>& found);

  fortran::unit_26 log_;
  outputs fortran_{};
  outputs cpp_{};
  std::vector<event> events_;
  std::string cpp_text_;
  std::int64_t calls_ = 0;
  tally tally_;
  branch_counts branches_;
  std::optional<std::string> first_;
};

extern template class side_by_side<float>;
extern template class side_by_side<double>;

}  // namespace contct
