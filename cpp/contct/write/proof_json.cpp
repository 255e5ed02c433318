#include <cmath>
#include <nlohmann/json.hpp>

#include "contct/write/result_json.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Sums of two doubles each.
json sums(const std::vector<double_double>& all) {
  return list_of(all, [](const double_double& x) -> json { return {x.hi, x.lo}; });
}

/// Rows of L, each from its first entry in the band to its diagonal.
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
  json step = {{"force", s.numbers.pair_forces},
               {"reactions", s.numbers.reactions},
               {"elements", s.numbers.element_values}};
  if (!s.of_stiffness) return step;  // it may stand anywhere: its displacements and statuses are not claimed
  step["displacement"] = s.displacement;
  step["state"] = list_of(s.isep, state_name);
  step["u"] = sums(s.state);
  step["closed"] = numbered(s.closed);
  step["z"] = sums(s.z);
  put_stiffness(step, *s.of_stiffness);
  return step;
}

std::string reason_without_proof(const std::optional<certificate>& c) {
  if (!c) return "the step did not reach its load";
  if (!c->proved) return c->problem;
  if (!c->unique) return "the structure balances, which this proof does not cover";
  return "the bounds are proved with a sparse factor, which is not written";
}

}  // namespace

std::string proof_json(const problem& p, const certifier& judged) {
  json steps = json::array();
  for (std::size_t i = 0; i < judged.steps().size(); ++i) {
    const auto& c = judged.steps()[i];
    json step = {{"step", i + 1}, {"certified", c && c->certified}, {"error", nullptr}};
    if (c && c->proof) {
      step["error"] = error_json(p, c);
      step.update(step_json(*c->proof));
    } else {
      step["because"] = reason_without_proof(c);
    }
    steps.push_back(std::move(step));
  }
  const json all = {{"format", "contct-proof-2"}, {"steps", std::move(steps)}};
  return json_text(all) + "\n";
}

}  // namespace contct
