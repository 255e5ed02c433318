// The proofs of the bounds of a run (reference/proof-format.md).
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "contct/proof/error_bounds.hpp"
#include "contct/write/result_json.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Each number as a list of two doubles, of which the number is the sum.
json sums(const std::vector<double_double>& all) {
  return list_of(all, [](const double_double& x) -> json { return {x.hi, x.lo}; });
}

/// The rows of L, each from the first column of its band to the diagonal.
template <class Band, class Number>
json rows_of(const Band& l, const Number& number) {
  json rows = json::array();
  for (int i = 0; i < l.order(); ++i) {
    json row = json::array();
    for (int j = l.first(i); j <= i; ++j) row.push_back(number(l.at(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

void put_stiffness(json& step, const stiffness_proof& s) {
  step["scale"] = list_of(s.scale, [](double x) { return std::ilogb(x); });
  step["row_of"] = s.row_of;
  step["shift"] = s.shift;
  std::visit([&](const auto& l) { step["L"] = rows_of(l, [](const double_double& x) { return x.hi; }); },
             s.factor);
  if (const auto* const l = std::get_if<long_band>(&s.factor))
    step["L_low"] = rows_of(*l, [](const double_double& x) { return x.lo; });
}

json step_json(const step_proof& s) {
  json step = {{"force", s.told.numbers.pair_forces},
               {"reactions", s.told.numbers.reactions},
               {"elements", s.told.numbers.element_values}};
  if (!s.of_stiffness) return step;  // neither displacements nor statuses are proved
  step["displacement"] = s.told.displacement;
  step["state"] = list_of(s.told.isep, state_name);
  step["u"] = sums(s.state);
  step["closed"] = numbered(s.closed);
  step["z"] = sums(s.z);
  put_stiffness(step, *s.of_stiffness);
  return step;
}

json mesh_proof_json(const mesh_error& e) {
  const bed_line& line = *e.line;
  json mesh = mesh_error_json(e);
  mesh.update({{"halvings", line.mesh->halvings},
               {"ends", line.ends},
               {"u", sums(line.u)},
               {"closed", numbered(line.closed)},
               {"parts", json::array()}});
  for (const line_element& on : line.elements)
    for (const line_part& part : on.parts) {
      json& out = mesh["parts"].emplace_back(
          json{{"before", part.before}, {"pressed", json::array()}, {"certain", json::array()}});
      for (const bed_along& b : part.beds) {
        if (b.pressed.length() > 0.0) out["pressed"].push_back(b.bed + 1);
        if (b.certain.length() > 0.0) out["certain"].push_back({b.bed + 1, b.certain.from, b.certain.to});
      }
    }
  put_stiffness(mesh, *line.held);
  return mesh;
}

std::string reason_without_proof(const std::optional<certificate>& c) {
  if (!c) return "the step did not reach its full load";
  if (!c->proved) return c->problem;
  if (!c->unique)
    return "the structure can move as a rigid body without work of the load; this proof does not cover this "
           "case";
  return "the bounds are proved with a sparse factor, which is not written";
}

}  // namespace

std::string proof_json(const run_result& r) {
  json steps = json::array();
  for (std::size_t i = 0; i < r.record.steps.size(); ++i) {
    const std::optional<certificate>& c = r.record.steps[i].judged;
    json step = {{"step", i + 1}, {"certified", c && c->certified}, {"error", nullptr}};
    if (c && c->proof) {
      step["error"] = error_json(r.what, c);
      step.update(step_json(*c->proof));
      if (!r.mesh.empty() && r.mesh[i].not_proved.empty() && c->proof->of_stiffness)
        step["mesh"] = mesh_proof_json(r.mesh[i]);
    } else {
      step["because"] = reason_without_proof(c);
    }
    steps.push_back(std::move(step));
  }
  const json all = {{"format", "contct-proof-2"}, {"steps", std::move(steps)}};
  return json_text(all) + "\n";
}

}  // namespace contct
