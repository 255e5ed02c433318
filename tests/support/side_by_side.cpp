#include "support/side_by_side.hpp"

#include "contct/kernel/contct.hpp"
#include "contct/kernel/log_text.hpp"

namespace contct {
namespace {
constexpr std::size_t text_block = std::size_t{1} << 20;
}

template <class Real>
call<Real> side_by_side<Real>::prepare(const call_inputs<Real>& in, outputs& out) const {
  constexpr Real before = not_an_answer;
  out.ss.assign(in.cc.size(), before);
  out.isep = in.isep;
  return {in.dd, in.dtest, in.cc, out.ss, before, in.id, out.isep, in.isurf, in.dof};
}

template <class Real>
void side_by_side<Real>::put(const call_inputs<Real>& in) {
  ++calls_;
  call<Real> left = prepare(in, fortran_);
  fortran::contct(left);
  fortran_.smin = left.smin;

  call<Real> right = prepare(in, cpp_);
  events_.resize(in.cc.size());
  const int happened = contct(right, std::span<event>(events_));
  append_log_text(right, std::span<const event>(events_).first(happened), cpp_text_);

  note(compare_answers<Real>({left.smin, left.ss, left.isep}, {right.smin, right.ss, right.isep}, tally_));
  branches_.count(left, in.isep);
  if (cpp_text_.size() > text_block) compare_gathered_text();
}

template <class Real>
void side_by_side<Real>::compare_gathered_text() {
  note(compare_text(log_.take(), cpp_text_, tally_));
  cpp_text_.clear();
}

template <class Real>
void side_by_side<Real>::note(const std::optional<mismatch>& found) {
  if (!found || first_) return;
  first_ = "call " + std::to_string(calls_) + ": " + found->field + "(" + std::to_string(found->index) +
           "): " + found->leader + " against " + found->follower;
}

template class side_by_side<float>;
template class side_by_side<double>;

}  // namespace contct
