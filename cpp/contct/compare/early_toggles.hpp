// Which pairs were toggled before they were at their face, and how far from it.
#pragma once

#include <vector>

#include "contct/path/observer.hpp"

namespace contct::compare {

/// A pair that was toggled away from its face.
struct early_toggle {
  int step;         ///< from 1
  int number;       ///< of the increment, from 1
  event what;       ///< pair from 0
  double distance;  ///< from the face when it was toggled
  double share;     ///< the same, of the largest deflection at any pair so far
};

/// Observes a path and remembers the toggles that were off their face by more than rounding.
class early_toggles final : public observer {
 public:
  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  /// In the order in which they happened.
  [[nodiscard]] const std::vector<early_toggle>& all() const { return all_; }

 private:
  struct distance_of {
    int pair;
    double distance;
  };
  std::vector<distance_of> last_call_;
  double largest_ = 0.0;
  std::vector<early_toggle> all_;
};

}  // namespace contct::compare
