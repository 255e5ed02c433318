// What rounding must not decide: which rigid-body motions are stopped, and what loads do on them. In rational
// numbers, from the decimals of the file.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/model/rigid_modes.hpp"

namespace contct {

struct beam;
struct contact_pair;
struct load;
struct plate;
struct resultant;

/// What the rigid-body motions of a beam or plate do at its dofs [dofs], in doubles.
template <class Kind>
[[nodiscard]] std::vector<rigid_row> rigid_rows_of(const Kind& kind);

/// The work of a load on each rigid-body motion of a beam or plate, exactly; or nothing, where that is not
/// known.
class rigid_work {
 public:
  struct numbers;
  rigid_work() = default;
  explicit rigid_work(std::shared_ptr<const numbers> exactly) : exactly_(std::move(exactly)) {}

  [[nodiscard]] bool is_known() const { return exactly_ != nullptr; }
  [[nodiscard]] const numbers& exactly() const { return *exactly_; }
  /// This work less another; not known where one of them is not.
  [[nodiscard]] rigid_work less(const rigid_work& other) const;

 private:
  std::shared_ptr<const numbers> exactly_;
};

/// A rigid-body motion, scaled so that the largest of its parts is 1.
struct free_motion {
  std::function<double(int dof)> at;  ///< what it does at a dof; 0 where the dof rests
  double work;                        ///< what the load does on it, positive
};

/// The rigid-body motions of a beam or plate: up by 1, and turns about its middle that lift an end by 1. A
/// beam with hinges has one for each of these and of its ends instead, which lifts it by 1 and leaves the
/// others.
class rigid_truth {
 public:
  explicit rigid_truth(const beam& b);
  explicit rigid_truth(const plate& p);

  /// How many they are.
  [[nodiscard]] int motions() const;

  /// Does dof `dof`, held, stop a motion that the dofs of `held` do not? These are independent of each other.
  [[nodiscard]] bool is_independent(std::span<const int> held, int dof) const;

  /// The work of `l`; its prescribed displacements do none.
  [[nodiscard]] rigid_work work_of(const load& l) const;

  /// See resultant_of.
  [[nodiscard]] resultant resultant_of(const load& l) const;

  /// The steepest of the motions that the dofs of `held`, independent of each other, leave free: none where
  /// `work`, which is known, is 0 on all of these. `rows`: rigid_rows_of the structure, which the motion
  /// uses.
  [[nodiscard]] std::optional<free_motion> driven_by(const rigid_work& work, std::span<const int> held,
                                                     std::span<const rigid_row> rows) const;

  /// Is there an equilibrium under a load of this `work`, which is known: do forces of the supports of
  /// `supported`, and of pairs that press, balance it? The energy of a structure is otherwise without a least
  /// value: some rigid-body motion that no pair and no support stops does work.
  [[nodiscard]] bool is_carried(const rigid_work& work, std::span<const int> supported,
                                std::span<const contact_pair> pairs) const;

 private:
  struct shape;
  std::shared_ptr<const shape> shape_;
};

}  // namespace contct
