#include "contct/path/frames.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/kernel/contct.hpp"
#include "contct/solve/engine.hpp"

namespace contct::path {

namespace {

std::vector<double> forces_at(const linear_structure& s, const step_state& end) {
  if (end.numbers != nullptr) return end.numbers->pair_forces;
  std::vector<double> forces;
  for (std::size_t p = 0; p < s.pairs.size(); ++p)
    forces.push_back(force_of(s.pairs[p], end.displacement[s.dof_of_pair(p)], end.isep[p] == in_contact));
  return forces;
}

}  // namespace

pair_look look_of(const contact_pair& p, double w, bool closed) {
  if (std::abs(p.face - w) < constants<double>::epsgap) return pair_look::at_face;
  return closed ? pair_look::closed : pair_look::open;
}

frame_keeper::frame_keeper(const linear_structure& s, load_history total_load, bool forces_by_law,
                           const frame_limits& limits)
    : structure_(s),
      total_load_(std::move(total_load)),
      forces_by_law_(forces_by_law),
      refined_(limits.refined),
      most_frames_(
          std::max(fewest_frames,
                   std::min(limits.most_frames, limits.most_numbers / std::max<std::size_t>(s.dofs(), 1)))),
      before_(s.dofs()),
      after_(before_),
      d_(s.pairs.size()),
      d_star_(s.pairs.size()),
      pair_force_(s.pairs.size()) {
  for (const contact_pair& p : s.pairs) isep_.push_back(p.closed ? in_contact : separated);
  frame start;
  start.displacement.resize(before_.size());
  start.isep = isep_;
  frames_.push_back(std::move(start));
}

void frame_keeper::called(const answered_call& c) {
  for (std::size_t i = 0; i < d_.size(); ++i) {
    const std::size_t dof = c.c.dof.dof_of(c.c.id[i]) - 1;
    d_[i] = c.c.dd[dof];
    d_star_[i] = c.c.dtest[dof];
  }
  isep_.assign(c.isep_before.begin(), c.isep_before.end());
}

void frame_keeper::incremented(const increment& i) {
  begin_step(i.step);
  ++increments_;
  for (std::size_t p = 0; p < d_.size(); ++p) {  // as the path itself advances
    if (isep_[p] == in_contact) pair_force_[p] -= structure_.pairs[p].stiffness * (i.s * d_star_[p]);
    d_[p] += i.s * d_star_[p];
  }
  if (!i.ahead.empty()) d_.assign(i.ahead.begin(), i.ahead.end());
  for (const event& e : i.events) isep_[e.pair] = e.what == change::make ? in_contact : separated;
  last_ = {.at = increments_,
           .step = i.step,
           .number = i.number,
           .fraction = i.fraction,
           .s = i.s,
           .snaps = i.snaps,
           .events = {i.events.begin(), i.events.end()},
           .isep = isep_,
           .pair_forces = forces_after(i)};
  show_latest();
  const bool kept = increments_ % stride_ == 0;
  if (!kept && !solves_each_) return;
  frame f = last_;
  f.displacement = shape(i.fraction);
  const bool solved = !f.displacement.empty();
  if (solves_each_) latest_ = f;
  unshown_ = solved && solves_each_;
  if (kept && solved) keep(std::move(f));
}

void frame_keeper::step_ended(const step_state& s) {
  begin_step(s.step);
  const bool after_increment = last_.step == s.step && !s.from_fallback;
  frame f =
      after_increment ? last_ : frame{.at = increments_, .step = s.step, .from_fallback = s.from_fallback};
  f.step_end = true;
  f.from_exact_path = s.from_exact_path;
  f.fraction = s.fraction;
  f.displacement.assign(s.displacement.begin(), s.displacement.end());
  f.isep.assign(s.isep.begin(), s.isep.end());
  if (s.numbers != nullptr) f.numbers = *s.numbers;
  f.pair_forces = forces_at(structure_, s);
  for (std::size_t p = 0; forces_by_law_ && p < pair_force_.size(); ++p)
    pair_force_[p] = -structure_.pairs[p].surface * f.pair_forces[p];
  if (after_increment) unshown_ = false;
  show_latest();
  if (visit_) visit_(f);
  if (after_increment && frames_.back().at == f.at && frames_.back().step == f.step) frames_.pop_back();
  keep(std::move(f));
}

/// Of the 1989 rule by the spring's law from D, otherwise as gathered since the pair came into contact: a
/// stiff spring's compression has more digits alone than within D.
std::vector<double> frame_keeper::forces_after(const increment& i) {
  std::vector<double> forces;
  for (std::size_t p = 0; p < d_.size(); ++p) {
    const contact_pair& at = structure_.pairs[p];
    forces.push_back(force_of(at, d_[p], isep_[p] == in_contact));
    if (!forces_by_law_) continue;
    if (!i.ahead.empty() || isep_[p] != in_contact) pair_force_[p] = -at.surface * forces[p];
    forces[p] = -at.surface * pair_force_[p];
  }
  return forces;
}

/// Empty where even all pairs together do not hold the structure.
std::vector<double> frame_keeper::shape(double fraction) {
  try {
    if (!can_be_solved()) return {};
    std::vector<double> load(before_.size());
    for (std::size_t i = 0; i < load.size(); ++i) load[i] = before_[i] + fraction * (after_[i] - before_[i]);
    std::vector<double> forces(d_.size());
    for (std::size_t p = 0; p < forces.size(); ++p) {
      const contact_pair& at = structure_.pairs[p];
      const double by_law = isep_[p] == in_contact ? -at.stiffness * (d_[p] - at.face) : 0.0;
      forces[p] = (forces_by_law_ ? by_law : pair_force_[p]) + at.stiffness * d_[p];
    }
    std::vector<double> u = with_pair_forces(structure_, load, forces);
    if (refined_) {
      stiffness_->solve_refined(std::vector(u), u);
    } else {
      stiffness_->solve(u);
    }
    return u;
  } catch (const no_factor&) {
    unsolvable_ = true;
    return {};
  }
}

/// The first frame and the latest stay in any case.
void frame_keeper::thin() {
  const bool steps_crowd =
      static_cast<std::size_t>(std::count_if(frames_.begin(), frames_.end(),
                                             [](const frame& f) { return f.step_end; })) > most_frames_ / 2;
  (steps_crowd ? step_stride_ : stride_) *= 2;
  const auto is_left_out = [this](const frame& f) {
    return f.step_end ? f.step % step_stride_ != 0 : f.at % stride_ != 0;
  };
  frames_.erase(std::remove_if(frames_.begin() + 1, frames_.end() - 1, is_left_out), frames_.end() - 1);
}

}  // namespace contct::path
