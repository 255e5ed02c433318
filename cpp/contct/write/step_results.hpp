// What an engineer reads off a state: extremes, reactions and contact forces; and off a whole path: its
// envelope.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/structure/extremes.hpp"
#include "contct/write/run_result.hpp"

namespace contct::write {

/// Read off one state. Pairs, supports and nodes count from 0.
struct step_results {
  std::vector<value_range> ranges;  ///< see ranges_of
  element_results elements;
  std::vector<double> reactions;    ///< [supports]
  std::vector<pair_reading> pairs;  ///< [pairs]

  /// The pair that presses hardest; none where no pair presses.
  [[nodiscard]] std::optional<std::size_t> hardest_pair() const;
  /// The support with the largest force: moments on supports do not count.
  [[nodiscard]] std::optional<std::size_t> hardest_support(const problem& p) const;
};

/// Of displacement `u` [dofs] and statuses `isep` [pairs] under load `l`. `deflecting`: see deflecting_nodes.
/// `numbers`: what is known better than from `u`; null: nothing.
[[nodiscard]] step_results results_of(const problem& p, const load& l, std::span<const double> u,
                                      std::span<const int> isep, std::span<const int> deflecting,
                                      const end_numbers* numbers = nullptr);
/// Of the end of a step, and of a frame.
[[nodiscard]] inline step_results results_of(const problem& p, const load& l, const step_state& s,
                                             std::span<const int> deflecting) {
  return results_of(p, l, s.displacement, s.isep, deflecting, s.numbers);
}
[[nodiscard]] inline step_results results_of(const problem& p, const load& l, const frame& f,
                                             std::span<const int> deflecting) {
  return results_of(p, l, f.displacement, f.isep, deflecting, f.numbers ? &*f.numbers : nullptr);
}

/// A beam that passes through a face between two neighbouring pairs that have it: contact there is not in the
/// model.
struct passage {
  double depth = 0.0;                 ///< beyond the face, and beyond where the pairs themselves are
  double x = 0.0;                     ///< where it is deepest
  std::size_t first = 0, second = 0;  ///< the pairs, from 0
};
/// The deepest one in a state, where that is more than a thousandth of the largest deflection.
[[nodiscard]] std::optional<passage> deepest_passage(const problem& p, const load& l,
                                                     std::span<const double> u);

/// The mean of what the elements at a node have there, for contours [nodes].
[[nodiscard]] std::vector<double> means_at_nodes(const plate& p, const element_results& results,
                                                 std::size_t name);

/// Beside a quantity of this size, the value is printed as 0.
[[nodiscard]] inline bool is_rounding(double value, double size) {
  return std::abs(value) <= 1e-12 * size;
}

/// Where ranges_of looks: "the whole length", "nodes and corners of elements" or "dofs".
[[nodiscard]] std::string_view ranges_are_at(const model& m);

/// A place in words: "node 9, x = 4", "x = 4.31", "node 9, (1, 0.5)" or "dof 185.3".
[[nodiscard]] std::string place_words(const model& m, const placed_value& at);

/// The unit of a quantity that goes with these powers of force (0 or 1) and length: "kN/m". Empty where the
/// problem has no units.
[[nodiscard]] std::string unit_words(const unit_labels& u, int force, int length);

/// The unit of a quantity, with a blank before it: of "w", "moment", "shear", "mx", "force", ..; empty where
/// the problem names no units.
[[nodiscard]] std::string unit_words(const problem& p, std::string_view quantity);

/// The least and largest of everything on a path.
class envelope {
 public:
  /// An increment of a step, from 1; 0: the step ended without one.
  struct when {
    int step = 0, increment = 0;
  };
  struct bound {
    placed_value at;
    when reached;
  };
  struct range {
    std::string_view name;
    bound least, most;
  };
  struct peak {
    double force = 0.0;
    when reached;
  };
  struct reaction_range {
    double least = 0.0, most = 0.0;
    when least_reached, most_reached;
  };

  /// `p` must outlive this object.
  explicit envelope(const problem& p) : problem_(p), loads_(p), deflecting_(deflecting_nodes(p)) {}

  /// A state of the path, the unloaded one excepted.
  void take(const frame& f);

  [[nodiscard]] int states() const { return states_; }
  [[nodiscard]] const std::vector<range>& ranges() const { return ranges_; }
  [[nodiscard]] const std::vector<peak>& pairs() const { return pairs_; }                    ///< [pairs]
  [[nodiscard]] const std::vector<reaction_range>& reactions() const { return reactions_; }  ///< [supports]

 private:
  const problem& problem_;
  load_path loads_;
  std::vector<int> deflecting_;
  int states_ = 0;
  std::vector<range> ranges_;
  std::vector<peak> pairs_;
  std::vector<reaction_range> reactions_;
};

}  // namespace contct::write
