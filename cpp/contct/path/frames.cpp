#include "contct/path/frames.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/kernel/contct.hpp"
#include "contct/solve/engine.hpp"

namespace contct::path {

namespace {

/// By the spring's law from D at each pair.
std::vector<double> forces_by_law(const linear_structure& s, std::span<const double> d,
                                  std::span<const int> isep) {
  std::vector<double> forces;
  for (std::size_t p = 0; p < d.size(); ++p)
    forces.push_back(force_of(s.pairs[p], d[p], isep[p] == in_contact));
  return forces;
}

std::vector<double> forces_at(const linear_structure& s, const step_state& end) {
  if (end.numbers != nullptr) return end.numbers->pair_forces;
  std::vector<double> d;
  for (std::size_t p = 0; p < s.pairs.size(); ++p) d.push_back(end.displacement[s.dof_of_pair(p)]);
  return forces_by_law(s, d, end.isep);
}

}  // namespace

pair_state look_of(const contact_pair& p, double w, bool closed) {
  if (std::abs(p.face - w) < constants<double>::epsgap) return pair_state::at_face;
  return closed ? pair_state::closed : pair_state::open;
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
      after_(before_) {
  frame start;
  start.displacement.resize(before_.size());
  for (const contact_pair& p : s.pairs) start.isep.push_back(p.closed ? in_contact : separated);
  frames_.push_back(std::move(start));
}

void frame_keeper::incremented(const increment& i) {
  begin_step(i.step);
  ++increments_;
  last_ = {.at = increments_,
           .step = i.step,
           .number = i.number,
           .fraction = i.fraction,
           .s = i.s,
           .snaps = i.snaps,
           .events = {i.events.begin(), i.events.end()},
           .isep = {i.isep.begin(), i.isep.end()},
           .pair_forces = forces_by_law(structure_, i.d, i.isep)};
  show_latest();
  const bool kept = increments_ % stride_ == 0;
  if (!kept && !solves_each_) return;
  frame f = last_;
  f.displacement = shape_after(i);
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
  if (after_increment) unshown_ = false;
  show_latest();
  if (visit_) visit_(f);
  if (after_increment && frames_.back().at == f.at && frames_.back().step == f.step) frames_.pop_back();
  keep(std::move(f));
}

/// Empty where even all pairs together do not hold the structure.
std::vector<double> frame_keeper::shape_after(const increment& i) {
  try {
    if (!can_be_solved()) return {};
    std::vector<double> load(before_.size());
    for (std::size_t dof = 0; dof < load.size(); ++dof)
      load[dof] = before_[dof] + i.fraction * (after_[dof] - before_[dof]);
    std::vector<double> forces(i.d.size());
    for (std::size_t p = 0; p < forces.size(); ++p) {
      const contact_pair& at = structure_.pairs[p];
      const double by_law = i.isep[p] == in_contact ? -at.stiffness * (i.d[p] - at.face) : 0.0;
      forces[p] = (forces_by_law_ ? by_law : i.pair_force[p]) + at.stiffness * i.d[p];
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
