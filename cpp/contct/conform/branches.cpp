#include "contct/conform/branches.hpp"

#include <algorithm>
#include <cmath>

namespace contct {

template <class Real>
void branch_counts::count(const call<Real>& c, std::span<const int> isep_before) {
  // The listing's DATA, converted from its decimal text in the precision of the call.
  const Real epsgap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  const Real epsmul = Real(1) / Real(256);
  Real smin = 1;
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    const auto ndof = static_cast<std::size_t>((c.id[i] - 1) * c.dof.ndofpn + c.dof.indof - 1);
    const Real dtest = c.dtest[ndof];
    if (!note(branch::no_response, dtest == 0) &&
        note(branch::stationary, std::abs(c.cc[i] - c.dd[ndof]) < epsgap)) {
      note(branch::check_positive, static_cast<Real>(isep_before[i] * c.isurf[i]) / dtest > 0);
    }
    if (note(branch::s_positive, c.ss[i] > 0) && note(branch::s_is_smallest, c.ss[i] < smin)) smin = c.ss[i];
  }
  if (note(branch::no_events, c.smin == 1)) return;
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    if (note(branch::within_epsmul, std::abs(c.ss[i] - c.smin) / c.smin < epsmul)) {
      note(branch::was_separated, isep_before[i] == separated);
    }
  }
}

template void branch_counts::count(const call<float>&, std::span<const int>);
template void branch_counts::count(const call<double>&, std::span<const int>);

std::int64_t branch_counts::rarest() const {
  std::int64_t least = counts_[0][0];
  for (const auto& both : counts_) least = std::min({least, both[0], both[1]});
  return least;
}

}  // namespace contct
