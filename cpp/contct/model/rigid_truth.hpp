// What rounding must not decide: which rigid motions are stopped, and what loads do on them. In rational
// numbers, from the decimals of the file.
#pragma once

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

/// What the rigid motions of a beam or plate do at its dofs [dofs], in doubles.
[[nodiscard]] std::vector<rigid_row> rigid_rows_of(const beam& b);
[[nodiscard]] std::vector<rigid_row> rigid_rows_of(const plate& p);

/// The work of a load on each rigid motion of a beam or plate, exactly; or nothing, where that is not known.
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

/// A rigid motion, scaled so that the largest of its parts is 1.
class free_motion {
 public:
  /// What moves by less than `still`, relative to the size of its row among `rows` [dofs], is at rest, unless
  /// `truth` decides that. `rows` must outlive this object. `work`: what the load does on the motion,
  /// positive.
  free_motion(const rigid_row& parts, std::span<const rigid_row> rows, double still, double work)
      : parts_(parts), rows_(rows), still_(still), work_(work) {}

  /// What it does at a dof; 0 where the dof rests.
  [[nodiscard]] double at(int dof) const;
  [[nodiscard]] double work() const { return work_; }

 private:
  friend class rigid_truth;
  rigid_row parts_;
  std::span<const rigid_row> rows_;
  double still_;
  double work_;
  // The same parts without rounding, and what evaluates them: they decide what is at rest, where they are
  // known.
  std::shared_ptr<const rigid_work::numbers> exactly_;
  std::shared_ptr<const class rigid_truth> truth_;
};

/// The rigid motions of a beam or plate: up by 1, and turns about its middle that lift an end by 1.
class rigid_truth : public std::enable_shared_from_this<rigid_truth> {
 public:
  explicit rigid_truth(const beam& b);
  explicit rigid_truth(const plate& p);
  ~rigid_truth();
  rigid_truth(const rigid_truth&) = delete;
  rigid_truth& operator=(const rigid_truth&) = delete;

  /// Does dof `dof`, held, stop a motion that the dofs of `held` do not? These are independent of each other.
  [[nodiscard]] bool is_independent(std::span<const int> held, int dof) const;

  /// The work of `l`; what it moves fixed dofs to does none.
  [[nodiscard]] rigid_work work_of(const load& l) const;

  /// See resultant_of.
  [[nodiscard]] resultant resultant_of(const load& l) const;

  /// The steepest of the motions that the dofs of `held`, independent of each other, leave free: none where
  /// `work`, which is known, is 0 on all of these. `rows`: rigid_rows_of the structure.
  [[nodiscard]] std::optional<free_motion> driven_by(const rigid_work& work, std::span<const int> held,
                                                     std::span<const rigid_row> rows) const;

  /// Is there an equilibrium under a load of this `work`, which is known: do forces of the supports of
  /// `supported`, and of pairs that press, balance it? The energy of a structure is otherwise without a least
  /// value: some rigid motion that no pair and no support stops does work.
  [[nodiscard]] bool is_carried(const rigid_work& work, std::span<const int> supported,
                                std::span<const contact_pair> pairs) const;

 private:
  friend class free_motion;
  struct shape;
  std::unique_ptr<const shape> shape_;
};

}  // namespace contct
