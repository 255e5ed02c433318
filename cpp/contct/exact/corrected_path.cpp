// Follows the exact path under the corrected rule, on which u is piecewise linear in the load. A
// complementarity problem decides which of the pairs at their faces are in contact on the next piece. A piece
// ends when a pair reaches or leaves its face.
#include <algorithm>
#include <set>
#include <utility>

#include "contct/exact/position.hpp"

namespace contct {
namespace {

/// The response of the structure, on an elastic ground of stiffness epsilon M, to the load increment R of the
/// step, for epsilon tending to 0:
///
///     y_0 / epsilon + y_1 + epsilon y_2 + ..
///     y_0 = sum of z z'R / z'Mz,   K y_1 = R - M y_0,   K y_2 = -M y_1,   ..,   z'M y_1 = z'M y_2 = .. = 0
///
/// K includes the springs of the pairs in contact; z: the rigid-body motions of K, with z_i'M z_j = 0.
class soft_ground {
 public:
  explicit soft_ground(const position& at) : at_(at) {
    for (const rational_vector& motion : at.solver().free_motions()) {
      rational_vector z = without_free_part(motion);
      rational_vector mz = weighed(z);
      const rational size = dot(z, mz);
      motions_.push_back({std::move(z), std::move(mz), size});
    }
  }

  [[nodiscard]] std::vector<rational_vector> response(std::size_t terms) const {
    std::vector<rational_vector> y = {rational_vector(at_.u.size())};
    for (const free_motion& m : motions_) add(y[0], m.z, dot(m.z, at_.increment()) / m.size);
    rational_vector rest = at_.increment();
    rational_vector settled = at_.settlement();
    while (y.size() < terms) {
      add(rest, weighed(y.back()), -1);
      y.push_back(without_free_part(at_.moved(rest, settled)));
      std::fill(rest.begin(), rest.end(), rational(0));
      std::fill(settled.begin(), settled.end(), rational(0));
    }
    return y;
  }

 private:
  struct free_motion {
    rational_vector z, mz;
    rational size;  // z'Mz
  };

  /// M v.
  [[nodiscard]] rational_vector weighed(const rational_vector& v) const {
    rational_vector mv(v.size());
    for (const added_spring& g : at_.problem.ground) mv[g.dof] += g.stiffness * v[g.dof];
    return mv;
  }

  [[nodiscard]] rational_vector without_free_part(rational_vector v) const {
    for (const free_motion& m : motions_) add(v, m.z, -dot(m.mz, v) / m.size);
    return v;
  }

  const position& at_;
  std::vector<free_motion> motions_;
};

class corrected_path final : public exact_rule {
 public:
  corrected_path(const exact_problem& p, const exact_progress& tell) : exact_rule(p, tell, true) {}

 private:
  path_status follow_step() override {
    while (begin_increment(increments_.size() + 1)) {
      const std::vector<int> before = at_.isep;
      settle_statuses();
      const bool driven = !is_zero(response_[0]);
      if (std::vector<event> events = at_.events_since(before); !events.empty() || driven)
        increments_.push_back({at_.fraction, std::move(events), driven});
      if (driven) {
        if (!snap()) return path_status::mechanism;
      } else if (!advance()) {
        increments_.push_back({at_.fraction, {}});
        return path_status::solved;
      }
    }
    fill_in();
    return path_status::iteration_limit;
  }

  /// Decides which pairs at their faces are in contact on the next piece: the response must not move a
  /// separated pair into its face, nor a pair in contact off its face. All wrong statuses are changed at
  /// once; if their number does not decrease for a while (Judice and Pires 1994), only the wrong status of
  /// least index is changed, which visits no set of statuses twice (Murty 1974). Throws std::runtime_error if
  /// the statuses cannot be decided.
  void settle_statuses() {
    std::vector<std::size_t> at_face;
    for (std::size_t i = 0; i < at_.isep.size(); ++i)
      if (at_.gap(i) == 0) at_face.push_back(i);
    std::size_t fewest = at_face.size() + 1;
    int patience = 3;
    std::set<std::vector<int>> seen;
    for (std::size_t terms = 2;;) {
      respond(terms);
      std::vector<std::size_t> wrong;
      for (const std::size_t i : at_face)
        if (moves(i) == at_.isep[i]) wrong.push_back(i);
      if (wrong.empty()) return;
      if (wrong.size() < fewest) {
        fewest = wrong.size();
        patience = 3;
        seen.clear();
      } else if (patience > 0) {
        --patience;
      } else if (!seen.insert(at_.isep).second) {  // statuses repeat: more terms are needed
        seen.clear();
        terms += 2;
        if (terms > most_terms)
          throw std::runtime_error("the status of the pairs at their faces could not be decided");
      }
      if (patience == 0) wrong.resize(1);
      for (const std::size_t i : wrong) at_.isep[i] *= -1;
    }
  }

  void respond(std::size_t terms) {
    at_.factor();
    response_ = soft_ground(at_).response(terms);
  }

  /// 1 if the response moves the pair towards its face, -1 if away from its face, 0 if neither. The first
  /// term that moves the pair decides.
  [[nodiscard]] int moves(std::size_t pair) const {
    for (const rational_vector& term : response_)
      if (const rational towards = at_.approach(pair, term); towards != 0) return towards > 0 ? 1 : -1;
    return 0;
  }

  /// The multiple of `v` at which the first event occurs: a separated pair reaches its face, or a pair in
  /// contact leaves its face. Empty if there is no event.
  [[nodiscard]] std::optional<rational> first_event_along(const rational_vector& v) const {
    std::optional<rational> way;
    for (std::size_t i = 0; i < at_.isep.size(); ++i) {
      const rational towards = at_.isep[i] * at_.approach(i, v);
      if (towards <= 0) continue;
      const rational reach = abs(at_.gap(i)) / towards;
      if (!way || reach < *way) way = reach;
    }
    return way;
  }

  /// Moves along the rigid-body motion that the load drives, up to the first face. If no face stops the
  /// motion, keeps the motion as proof of the mechanism and returns false.
  bool snap() {
    fill_in();
    const rational_vector& motion = response_[0];
    const std::optional<rational> way = first_event_along(motion);
    if (way)
      add(at_.u, motion, *way);
    else
      prove(motion);
    return way.has_value();
  }

  void prove(const rational_vector& motion) {
    if (mechanism_) return;
    rational largest;
    for (const rational& x : motion) largest = std::max(largest, rational(abs(x)));
    mechanism_proof proof{rational_vector(motion.size()), 0};
    add(proof.motion, motion, 1 / largest);
    proof.work = dot(proof.motion, at_.problem.steps[at_.step].force);
    mechanism_ = std::move(proof);
  }

  /// Increases the load up to the first event or the end of the step. False at the end of the step.
  bool advance() {
    if (!at_.solver().free_motions().empty()) fill_in();
    const std::optional<rational> way = first_event_along(response_[1]);
    const rational left = 1 - at_.fraction;
    const bool goes_on = way && *way < left;
    move_on(goes_on ? *way : left);
    if (!goes_on) fill_in();
    return goes_on;
  }

  /// Advances the share of the step by `way`, and u with it. If the springs hold the structure, u is computed
  /// from the load at the start of the step, so that numbers do not become longer along the path; until
  /// fill_in(), u is computed only at pairs.
  void move_on(const rational& way) {
    at_.fraction += way;
    if (!at_.solver().free_motions().empty()) {
      add(at_.u, response_[1], way);
      return;
    }
    line_start_ = at_.at_start_of_step();
    line_rate_ = std::move(response_[1]);
    for (const exact_pair& c : at_.problem.pairs)
      for (const int dof : {c.dof, c.other})
        if (dof >= 0) put_on_line(dof);
  }

  void put_on_line(std::size_t dof) { at_.u[dof] = line_start_[dof] + at_.fraction * line_rate_[dof]; }

  /// Computes u at all dofs.
  void fill_in() {
    for (std::size_t dof = 0; dof < line_start_.size(); ++dof) put_on_line(dof);
    line_start_.clear();
  }

  static constexpr std::size_t most_terms = 12;
  std::vector<rational_vector> response_;
  rational_vector line_start_, line_rate_;  // on this piece, u = line_start_ + fraction * line_rate_
};

}  // namespace

exact_path follow_corrected_path(const exact_problem& p, const exact_progress& tell) {
  return corrected_path(p, tell).follow();
}

}  // namespace contct
