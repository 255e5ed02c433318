#include "contct/path/policy.hpp"

#include <limits>

namespace contct::path {

bool path_policy::reaches_full_load(double s_min) const {
  constexpr double never_less = 1e-9;
  constexpr double never_more = 1e-6;
  const double share_left = now_.residual.share * (1.0 - s_min);
  if (share_left > never_more) return false;
  if (share_left <= never_less) return true;
  return share_left <= std::numeric_limits<double>::epsilon() / now_.engine.reciprocal_condition();
}

void path_policy::leave_undone(double& s_min) {
  now_.take_back_toggles();
  s_min = 1.0;
}

response policy_1989::respond() {
  if (!now_.held()) return response::none;
  now_.engine.respond(now_.residual, now_.d_star);
  return response::elastic;
}

bool policy_1989::accept(double& s_min) {
  if (s_min < 1.0 && reaches_full_load(s_min)) leave_undone(s_min);
  return true;
}

void policy_1989::displace(std::span<double> u) {
  now_.engine.recover(now_.applied_load(), now_.forces_gathered(), u);
}

}  // namespace contct::path
