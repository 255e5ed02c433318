// A plate as the numbers that rank 0 sends of it.
#pragma once

#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::distributed::petsc {

[[nodiscard]] inline std::vector<double> packed(const structure::plate& p) {
  std::vector<double> all = {p.D, p.nu, p.E, p.thickness};
  for (const std::vector<double>* line : {&p.x, &p.y}) {
    all.push_back(static_cast<double>(line->size()));
    all.insert(all.end(), line->begin(), line->end());
  }
  for (const std::vector<structure::even_run>* runs : {&p.x_runs, &p.y_runs}) {
    all.push_back(static_cast<double>(runs->size()));
    for (const structure::even_run& run : *runs)
      all.insert(all.end(), {run.end, static_cast<double>(run.elements)});
  }
  return all;
}

[[nodiscard]] inline structure::plate unpacked(const std::vector<double>& all) {
  structure::plate p;
  std::size_t at = 0;
  const auto next = [&] { return all[at++]; };
  for (double* number : {&p.D, &p.nu, &p.E, &p.thickness}) *number = next();
  for (std::vector<double>* line : {&p.x, &p.y}) {
    line->resize(static_cast<std::size_t>(next()));
    for (double& x : *line) x = next();
  }
  for (std::vector<structure::even_run>* runs : {&p.x_runs, &p.y_runs}) {
    runs->resize(static_cast<std::size_t>(next()));
    for (structure::even_run& run : *runs) {
      run.end = next();
      run.elements = static_cast<int>(next());
    }
  }
  return p;
}

}  // namespace contct::distributed::petsc
