#include "contct/structure/model.hpp"

#include <utility>

namespace contct::structure {
namespace {

element_results table_of(const beam& b, const load& l, std::span<const double> u) {
  element_results r{{"shear", "moment"}, 2, {}};
  for (const element_forces& e : forces_in_elements(b, l, u)) {
    r.values.insert(r.values.end(), {e.shear[0], e.shear[1], e.moment[0], e.moment[1]});
  }
  return r;
}

element_results table_of(const plate& p, const load& /*l*/, std::span<const double> u) {
  element_results r{{"mx", "my", "mxy"}, 4, {}};
  for (const corner_moments& e : moments_in_elements(p, u)) {
    for (const auto& quantity : {e.mx, e.my, e.mxy})
      r.values.insert(r.values.end(), quantity.begin(), quantity.end());
  }
  return r;
}

element_results table_of(const assembled& /*a*/, const load& /*l*/, std::span<const double> /*u*/) {
  return {};  // a matrix has no elements
}

// A consistent vector has the same resultant as the load itself.
resultant resultant_of_vector(const beam& b, std::span<const double> f) {
  resultant r{0.0, {0.0}};
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    r.force += f[2 * i];
    r.moments[0] += f[2 * i] * b.x[i] + f[2 * i + 1];
  }
  return r;
}

resultant resultant_of_vector(const plate& p, std::span<const double> f) {
  resultant r{0.0, {0.0, 0.0}};
  std::size_t dof = 0;
  for (const double y : p.y) {
    for (const double x : p.x) {
      r.force += f[dof];
      r.moments[0] += f[dof] * x + f[dof + 1];
      r.moments[1] += f[dof] * y + f[dof + 2];
      dof += 3;
    }
  }
  return r;
}

resultant resultant_of_vector(const assembled& /*a*/, std::span<const double> f) {
  resultant r;
  for (const double at_dof : f) r.force += at_dof;
  return r;
}

}  // namespace

int nodes(const model& m) {
  return std::visit([](const auto& kind) { return kind.nodes(); }, m.kind);
}

int elements(const model& m) {
  return std::visit([](const auto& kind) { return kind.elements(); }, m.kind);
}

int dofs(const model& m) {
  return std::visit([](const auto& kind) { return kind.dofs(); }, m.kind);
}

int dofs_per_node(const model& m) {
  return std::visit([](const auto& kind) { return kind.dofs_per_node; }, m.kind);
}

std::span<const char* const> dof_names(const model& m) {
  return std::visit([](const auto& kind) { return std::span<const char* const>(kind.dof_names); }, m.kind);
}

std::string_view node_name(const model& m) {
  return std::holds_alternative<assembled>(m.kind) ? "dof" : "node";
}

std::string place_words(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? "dof " + a->label_of(node) : "node " + std::to_string(node + 1);
}

linear_structure build(const model& m, std::span<const support> supports, std::vector<contact_pair> pairs) {
  return std::visit([&](const auto& kind) { return build(kind, supports, std::move(pairs)); }, m.kind);
}

void add_consistent_loads(const model& m, const load& l, std::span<double> f) {
  std::visit([&](const auto& kind) { add_consistent_loads(kind, l, f); }, m.kind);
}

std::vector<double> tributary_shares(const model& m) {
  return std::visit([](const auto& kind) { return tributary_shares(kind); }, m.kind);
}

std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  return std::visit([&](const auto& kind) { return reactions(kind, l, supports, u); }, m.kind);
}

element_results results_in_elements(const model& m, const load& l, std::span<const double> u) {
  return std::visit([&](const auto& kind) { return table_of(kind, l, u); }, m.kind);
}

resultant resultant_of(const model& m, const load& l) {
  std::vector<double> f(dofs(m), 0.0);
  add_consistent_loads(m, l, f);
  return std::visit([&](const auto& kind) { return resultant_of_vector(kind, f); }, m.kind);
}

}  // namespace contct::structure
