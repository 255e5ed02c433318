#include "contct/certify/share_bounds.hpp"

#include <algorithm>

namespace contct::certify {
namespace {

// From what refined states leave to how early the 1989 rule may toggle (1/256).
constexpr double distances[] = {0x1p-48, 0x1p-44, 0x1p-40, 0x1p-36, 0x1p-32,
                                0x1p-26, 0x1p-20, 0x1p-12, 0x1p-7};
constexpr double of_shares = 0x1p-50;  // of sums of two shares

/// Does each pair have the status that it has after its event, or before it?
bool have_statuses(std::span<const event> events, const std::vector<int>& certain, bool after) {
  return std::ranges::all_of(events, [&](const event& e) {
    return certain[e.pair] == ((e.what == change::make) == after ? in_contact : separated);
  });
}

}  // namespace

share_prover::share_prover(const linear_structure& s, const load_history& total_load, error_prover& prover)
    : structure_(s), total_load_(total_load), prover_(prover), reference_(s) {
  for (const contact_pair& p : s.pairs) at_first_.push_back(p.closed ? in_contact : separated);
}

std::optional<double> share_prover::bound(const path::increment& i) {
  proof_.reset();
  if (i.events.empty()) return i.fraction == 1.0 ? std::optional(0.0) : std::nullopt;
  for (const double distance : distances) {
    const double before = i.fraction - distance;
    const double after = std::min(i.fraction + distance, 1.0);
    if (!have_statuses(i.events, statuses_at(i.step, after), true)) continue;
    std::optional<status_proof> behind = std::move(of_statuses_);
    if (!have_statuses(i.events, statuses_at(i.step, before), false)) continue;
    const double error = distance + of_shares;
    if (behind && of_statuses_)
      proof_ = share_proof{
          i.number,          i.fraction, error, {i.events.begin(), i.events.end()}, std::move(*of_statuses_),
          std::move(*behind)};
    return error;
  }
  return std::nullopt;
}

/// Certain statuses [pairs]; 0 for a pair that has none. Before the load of a step begins to act, that of the
/// step before acts; before that of the first one, pairs have the statuses that the problem gives them.
std::vector<int> share_prover::statuses_at(int step, double share) {
  if (share <= 0.0 && step > 1) return statuses_at(step - 1, 1.0 + share);
  if (share <= 0.0) {
    of_statuses_ =
        status_proof{.step = step, .share = share, .state = {}, .closed = {}, .z = {}, .of_stiffness = {}};
    return at_first_;
  }
  std::vector<int> certain = statuses_under_load(step, share);
  of_statuses_ = prover_.take_status_proof();
  return certain;
}

std::vector<int> share_prover::statuses_under_load(int step, double share) {
  std::vector<double> load(structure_.dofs());
  if (step > 1) total_load_(step - 1, load);
  std::vector<double> full(load.size());
  total_load_(step, full);
  for (std::size_t dof = 0; dof < load.size(); ++dof) load[dof] += share * (full[dof] - load[dof]);
  const reference_answer near = reference_.solve(load);
  if (near.how != reference_answer::outcome::found) return std::vector<int>(structure_.pairs.size());
  return prover_.certain_statuses(step, share, near.displacement);
}

}  // namespace contct::certify
