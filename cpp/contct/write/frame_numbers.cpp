#include "contct/write/frame_numbers.hpp"

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

std::vector<int> deflecting_nodes(const problem& p) {
  std::vector<char> is_length(static_cast<std::size_t>(nodes(p.geometry)), 1);
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a != nullptr && (a->places.known() || !p.pairs.empty())) {
    for (std::size_t dof = 0; dof < is_length.size(); ++dof)
      is_length[dof] = a->places.known() && a->places.dofs[dof].is_length() ? 1 : 0;
    for (const contact_pair& pair : p.pairs) is_length[static_cast<std::size_t>(pair.node)] = 1;
  }
  std::vector<int> list;
  for (std::size_t node = 0; node < is_length.size(); ++node)
    if (is_length[node] != 0) list.push_back(static_cast<int>(node));
  return list;
}

extreme largest_deflection(const problem& p, const frame& f, std::span<const int> among) {
  extreme most{among.empty() ? 0 : static_cast<std::size_t>(among.front()), 0.0};
  for (const int number : among) {
    const auto node = static_cast<std::size_t>(number);
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

std::string place_name(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? a->label_of(node) : std::to_string(node + 1);
}

place place_of_node(const model& m, int node) {
  if (const auto* b = std::get_if<beam>(&m.kind)) return {b->x[static_cast<std::size_t>(node)], 0.0};
  const auto* p = std::get_if<plate>(&m.kind);
  if (p == nullptr) return {static_cast<double>(node), 0.0};
  return {p->x[static_cast<std::size_t>(node % p->columns())],
          p->y[static_cast<std::size_t>(node / p->columns())]};
}

}  // namespace contct
