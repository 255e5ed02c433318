// What goes into one call of CONTCT, owned.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "contct/kernel/call.hpp"

namespace contct::kernels {

/// What goes into one call. dd and dtest may be longer than the dofs in use.
template <class Real>
struct call_inputs {
  std::vector<Real> dd, dtest;       ///< [dofs]
  std::vector<Real> cc;              ///< [pairs]
  std::vector<int> id, isep, isurf;  ///< [pairs]
  dof_layout dof;

  [[nodiscard]] std::size_t pairs() const { return cc.size(); }
  /// The dof of pair `i`, from 0: its place in dd and dtest.
  [[nodiscard]] std::size_t dof_of_pair(std::size_t i) const { return dof.dof_of(id[i]) - 1; }
};

/// What SMIN and SS hold before a call: no kernel may leave it behind.
inline constexpr double not_an_answer = -7.0;

/// What comes out of one call.
struct call_outputs {
  double smin = 0.0;
  std::vector<double> ss;  ///< [pairs]
  std::vector<int> isep;   ///< [pairs]
  std::string text;        ///< unit 26, of a kernel that has text

  /// Ready for a call with `in`: outputs hold what no kernel may leave behind, ISEP what goes in.
  call<double> prepare(const call_inputs<double>& in) {
    ss.assign(in.pairs(), not_an_answer);
    isep = in.isep;
    return {in.dd, in.dtest, in.cc, ss, not_an_answer, in.id, isep, in.isurf, in.dof};
  }
};

}  // namespace contct::kernels
