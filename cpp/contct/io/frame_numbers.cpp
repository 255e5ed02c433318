#include "contct/io/frame_numbers.hpp"

#include <cmath>

namespace contct {

load load_of(const load_path& loads, const frame& f) {
  return f.step == 0 ? load{} : loads.at(f.step, f.fraction);
}

double deflection_of(const problem& p, const frame& f, std::size_t node) {
  return f.displacement[node * static_cast<std::size_t>(dofs_per_node(p.geometry))];
}

pair_reading reading_of(const problem& p, const frame& f, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  const double w = deflection_of(p, f, static_cast<std::size_t>(at.node));
  const bool closed = f.closed(pair);
  return {w, gap_of(at, w, closed), force_of(at, w, closed), look_of(at, w, closed)};
}

extreme largest_deflection(const problem& p, const frame& f) {
  extreme most;
  for (std::size_t node = 0; node < static_cast<std::size_t>(nodes(p.geometry)); ++node) {
    const double w = deflection_of(p, f, node);
    if (std::abs(w) > std::abs(most.value)) most = {node, w};
  }
  return most;
}

pair_counts count_pairs(const problem& p, const frame& f) {
  pair_counts n;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) ++n.of(reading_of(p, f, i).look);
  return n;
}

const char* words_of(pair_look look) {
  switch (look) {
    case pair_look::open:
      return "open";
    case pair_look::closed:
      return "closed";
    case pair_look::at_face:
      return "at its face";
  }
  return "";
}

place place_of_node(const model& m, int node) {
  if (const auto* b = std::get_if<beam>(&m.kind)) return {b->x[static_cast<std::size_t>(node)], 0.0};
  const auto* p = std::get_if<plate>(&m.kind);
  if (p == nullptr) return {static_cast<double>(node), 0.0};
  return {p->x[static_cast<std::size_t>(node % p->columns())],
          p->y[static_cast<std::size_t>(node / p->columns())]};
}

}  // namespace contct
