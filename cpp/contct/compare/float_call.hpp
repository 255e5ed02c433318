// A 4-byte kernel's call, told in double precision, as the kernel itself saw it.
#pragma once

#include <span>
#include <vector>

#include "contct/kernel/call.hpp"

namespace contct {

/// Holds the rounded copies; `c` must outlive it.
class float_call {
 public:
  explicit float_call(const call<double>& c)
      : c_(c), dd_(floats(c.dd)), dtest_(floats(c.dtest)), cc_(floats(c.cc)), ss_(floats(c.ss)) {}

  [[nodiscard]] call<float> as_call() {
    return {dd_, dtest_, cc_, ss_, static_cast<float>(c_.smin), c_.id, c_.isep, c_.isurf, c_.dof};
  }

 private:
  static std::vector<float> floats(std::span<const double> wide) { return {wide.begin(), wide.end()}; }

  const call<double>& c_;
  std::vector<float> dd_, dtest_, cc_, ss_;
};

}  // namespace contct
