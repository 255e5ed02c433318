// The accuracy of a kernel's path, compared with the exact one: its events, and the number of correct digits.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// The accuracy of one kernel's path.
struct kernel_digits {
  std::string name;
  bool same_events = true;
  std::string first_difference;  ///< of events or ends, as text; empty if there is none
  /// Correct digits, 0 to 16, of the worst displacement, share of an event and force, at the ends of the
  /// steps that both paths reached. Errors are relative to the largest of their kind on the path (a slope's
  /// at least to the largest deflection over the structure's length). Shares are those of events that are the
  /// same.
  double digits = 16.0, event_digits = 16.0, force_digits = 16.0;
  /// The number of compared ends of steps; if 0, digits and force_digits mean nothing.
  std::size_t steps = 0;
};

/// Observes a kernel's path.
class digit_counter final : public observer {
 public:
  /// Both must outlive this object.
  digit_counter(const problem& p, const exact_path& exactly);

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  /// `tie`: events whose shares differ by less may come in any order.
  [[nodiscard]] kernel_digits result(const std::string& name, path_status ended, double tie) const;

 private:
  /// An event on the whole path, at step number (from 0) + share.
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
  std::size_t steps_ = 0;          // that reached their load
  std::vector<rational> largest_;  // of each kind of dof
  std::vector<rational> error_;    // likewise
  rational largest_force_, force_error_;
};

}  // namespace contct
