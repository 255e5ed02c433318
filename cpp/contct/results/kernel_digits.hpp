// Compares the path of a kernel with the exact path: its events, and its number of correct digits.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/path/observer.hpp"
#include "contct/proof/solved_path.hpp"

namespace contct {

struct kernel_digits {
  std::string name;
  bool same_events = true;
  std::string first_difference;  ///< difference of events or ends, in words; empty if there is none
  /// Correct digits, from 0 to 16, of the displacement, the share of an event and the contact force with the
  /// largest error. Displacements and forces are compared at the ends of steps that both paths reached,
  /// shares for equal events. Errors of displacements and forces are relative to the largest number of the
  /// kind on the exact path; for slopes, to at least the largest deflection divided by the length of the
  /// structure.
  double digits = 16.0, event_digits = 16.0, force_digits = 16.0;
  /// The number of ends of steps that were compared; if 0, digits and force_digits have no meaning.
  std::size_t steps = 0;
};

class digit_counter final : public observer {
 public:
  /// Both arguments must outlive this object.
  digit_counter(const problem& p, const exact_path& exactly);

  void incremented(const increment& i) override;
  /// Compares the end of a step.
  void take(const solved_step& s);

  /// The comparison so far. `ended`: the status of the kernel's path. `tie`: events whose shares differ by
  /// less than `tie` may come in any order.
  [[nodiscard]] kernel_digits result(const std::string& name, path_status ended, double tie) const;

 private:
  /// An event. `place`: number of the step, from 0, plus share of the step.
  struct placed_event {
    double place;
    event what;
  };
  using event_list = std::vector<placed_event>;

  [[nodiscard]] bool is_ambiguous_event(const placed_event& e, double tie) const;
  [[nodiscard]] event_list decided(const event_list& events, double tie) const;
  [[nodiscard]] event_list exact_events() const;
  void compare_events(kernel_digits& r, double tie) const;
  [[nodiscard]] static std::string words(const placed_event& e);

  const problem& problem_;
  const exact_path& exactly_;
  event_list events_;
  std::size_t steps_ = 0;          // number of steps whose ends were compared
  std::vector<rational> largest_;  // largest exact displacement of each kind of dof
  std::vector<rational> error_;    // largest error of each kind of dof
  rational largest_force_, force_error_;
};

}  // namespace contct
