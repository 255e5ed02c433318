#include "contct/results/path_states.hpp"

#include <algorithm>
#include <utility>

namespace contct {

namespace {

/// Keeps every second increment, then every fourth, and so on, until at most `most` moments are left. If ends
/// of steps are more than half of `most`, keeps every second end, and so on. The last moment stays.
std::vector<path_moment> thinned(std::vector<path_moment> all, std::size_t most) {
  int stride = 1;
  int step_stride = 1;
  while (all.size() > most && all.size() > 1) {
    const auto ends = static_cast<std::size_t>(std::ranges::count(all, true, &path_moment::is_end));
    (2 * ends > most ? step_stride : stride) *= 2;
    std::vector<path_moment> kept;
    for (const path_moment& m : all)
      if (&m == &all.back() || (m.is_end ? m.step->step % step_stride : m.at % stride) == 0)
        kept.push_back(m);
    all.swap(kept);
  }
  return all;
}

/// Removes all but the last of the increments at the beginning of each step (see first_load).
std::vector<path_moment> without_first_moves(std::vector<path_moment> all) {
  const auto begins = [](const path_moment& m) {
    return m.increment != nullptr && m.increment->fraction <= first_load;
  };
  std::vector<path_moment> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i + 1 == all.size() || all[i + 1].step != all[i].step || !begins(all[i]) || !begins(all[i + 1]))
      kept.push_back(all[i]);
  return kept;
}

}  // namespace

std::vector<path_moment> moments_of(const run_result& r) {
  std::vector<path_moment> all;
  int at = 0;
  for (const solved_step& s : r.record.steps) {
    const bool ends_alone = s.number == 0;
    for (const increment_record& i : s.increments)
      all.push_back({&s, &i, !ends_alone && &i == &s.increments.back(), ++at});
    if (ends_alone) all.push_back({&s, nullptr, true, at});
  }
  return all;
}

std::size_t bytes_of_state(const problem& p) {
  constexpr std::size_t of_element = 600;
  return std::size_t{20} * dofs(p.geometry) + 100 * p.pairs.size() + 55 * p.supports.size() +
         of_element * elements(p.geometry) + 1;
}

path_states::path_states(const run_result& r)
    : run_(r),
      structure_(r.structure),
      total_load_(r.what, structure_),
      before_(structure_.dofs()),
      after_(before_) {}

structure_state path_states::at(const path_moment& m) {
  if (m.is_end) return static_cast<const structure_state&>(*m.step);
  const increment_record& i = *m.increment;
  structure_state s{.step = i.step, .number = i.number, .fraction = i.fraction, .isep = i.isep};
  s.displacement = shape_after(i);
  for (std::size_t pair = 0; pair < i.d.size(); ++pair)
    s.numbers.pair_forces.push_back(force_of(run_.what.pairs[pair], i.d[pair], s.closed(pair)));
  return s;
}

void path_states::begin_step(int step) {
  for (; step_ < step; ++step_) {
    before_.swap(after_);
    after_ = total_load_.total(step_ + 1);
  }
  if (total_load_.from_zero(step)) std::ranges::fill(before_, 0.0);
}

/// Factors K with the springs of all pairs, once. False if supports and all pairs do not hold the structure.
bool path_states::can_be_solved() {
  if (stiffness_ || unsolvable_) return !unsolvable_;
  unsolvable_ = !structure_.is_held(structure_.held_by([](std::size_t) { return true; }));
  try {
    if (!unsolvable_) stiffness_.emplace(structure_).factor(std::vector<char>(structure_.pairs.size(), 1));
  } catch (const no_factor&) {
    unsolvable_ = true;
  }
  return !unsolvable_;
}

std::vector<double> path_states::shape_after(const increment_record& i) {
  if (!can_be_solved()) return {};
  begin_step(i.step);
  std::vector<double> load(before_.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof)
    load[dof] = before_[dof] + i.fraction * (after_[dof] - before_[dof]);
  std::vector<double> forces(i.d.size());
  for (std::size_t p = 0; p < forces.size(); ++p) {
    const pair_in<double>& at = structure_.pairs[p];
    const double by_law = -at.surface * force_of(at, i.d[p], i.isep[p] == in_contact);
    forces[p] = (run_.end.by_1989_rule ? i.pair_force[p] : by_law) + at.stiffness * i.d[p];
  }
  std::vector<double> u = with_pair_forces(structure_, load, forces);
  stiffness_->solve_refined(std::vector(u), u);
  const std::vector<double> before = total_load_.moved_before(i.step);
  const std::vector<double> after = total_load_.moved(i.step);
  for (std::size_t dof = 0; dof < after.size(); ++dof)
    u[dof] += i.fraction * after[dof] + (before.empty() ? 0.0 : (1.0 - i.fraction) * before[dof]);
  return u;
}

std::vector<structure_state> pictures_of(const run_result& r, std::size_t most, std::size_t most_numbers) {
  constexpr std::size_t fewest = 4;
  structure_state start;
  start.displacement.resize(dofs(r.what.geometry));
  start.isep = statuses_at_start(r.what.pairs);
  most = std::max(fewest, std::min(most, most_numbers / std::max<std::size_t>(start.displacement.size(), 1)));
  std::vector<structure_state> all = {std::move(start)};
  path_states states(r);
  for (const path_moment& m : thinned(without_first_moves(moments_of(r)), most - 1))
    if (structure_state s = states.at(m); !s.displacement.empty()) all.push_back(std::move(s));
  return all;
}

}  // namespace contct
