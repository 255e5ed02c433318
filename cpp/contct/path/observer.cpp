#include "contct/path/observer.hpp"

namespace contct::path {

void tell_end(step_state end, const state_refiner& refine, std::span<observer* const> observers) {
  std::vector<double> displacement;
  std::vector<int> isep;
  std::optional<end_numbers> numbers;
  if (refine && end.fraction == 1.0) {
    displacement.assign(end.displacement.begin(), end.displacement.end());
    isep.assign(end.isep.begin(), end.isep.end());
    numbers = refine(end.step, displacement, isep);
  }
  if (numbers) {
    end.displacement = displacement;
    end.isep = isep;
    end.numbers = &*numbers;
  }
  for (observer* o : observers) o->step_ended(end);
}

}  // namespace contct::path
