#include "contct/results/path_observers.hpp"

#include <algorithm>
#include <cmath>

namespace contct {

void early_toggles::called(const answered_call& c) {
  distances_.clear();
  for (std::size_t i = 0; i < c.isep_before.size(); ++i) {
    const int dof = c.c.dof.dof_of(c.c.id[i]) - 1;
    const double reached = c.c.dd[dof] + c.c.smin * c.c.dtest[dof];
    if (std::abs(reached) > largest_ && std::isfinite(reached)) largest_ = std::abs(reached);
    if (c.c.isep[i] != c.isep_before[i]) distances_[static_cast<int>(i)] = std::abs(c.c.cc[i] - reached);
  }
}

void early_toggles::incremented(const increment& i) {
  const double rounding = rounding_share(sizeof(double)) * largest_;
  for (const event& e : i.events) {
    const auto off = distances_.find(e.pair);
    if (off != distances_.end() && off->second > rounding)
      all_.push_back({i.step, i.number, e, off->second, off->second / largest_});
  }
}

trace_recorder::trace_recorder(const trace_header& h, sink to) : to_(std::move(to)) {
  append_header(h, text_);
  to_(text_);
}

void trace_recorder::called(const answered_call& c) {
  text_.clear();
  append_call(c, "", text_);
  to_(text_);
}

explained_path::explained_path(const kernel_facts& leader, std::span<const std::string> second,
                               increments_wanted wanted, sink to)
    : lockstep_on_path(leader, second), real_bytes_(leader.real_bytes), wanted_(wanted), to_(std::move(to)) {}

void explained_path::called(const answered_call& c) {
  put(c);
  // Unrequested calls are explained too: they update the largest deflection, to which rounding is relative.
  call_ = explain(c, real_bytes_, largest_);
}

void explained_path::incremented(const increment& i) {
  steps_ += i.number == 1 ? 1 : 0;
  const double before = std::exchange(fraction_, i.fraction);
  if (wanted_.step == 0 || wanted_.step == i.step) most_increments_ = std::max(most_increments_, i.number);
  if (!wanted_.holds(i.step, i.number)) return;
  ++explained_;
  const follower* const second = followers().empty() ? nullptr : &followers().front();
  to_({i, i.number == 1 ? 0.0 : before, call_,
       second != nullptr && second->answered() ? &second->answer() : nullptr,
       second != nullptr ? second->difference() : std::nullopt, call_.winner >= 0 && i.events.empty()});
}

}  // namespace contct
