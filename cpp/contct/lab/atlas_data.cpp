#include "contct/lab/atlas_data.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// A cell without EPSMUL, or without errors, has null there.
json cell_json(const atlas_cell& c) {
  const confidence wrong = wilson(c.wrong, c.problems);
  const confidence uncertified = wilson(c.uncertified, c.problems);
  return {{"structures", c.held ? "held" : "free"},
          {"kernel", c.kernel},
          {"epsmul", c.epsmul == 0.0 ? json() : json(c.epsmul)},
          {"unit", c.unit},
          {"problems", c.problems},
          {"wrong", c.wrong},
          {"wrong_least", wrong.least},
          {"wrong_most", wrong.most},
          {"median_error", c.errors.empty() ? json() : json(median_error(c))},
          {"worst_error", c.errors.empty() ? json() : json(worst_error(c))},
          {"false_equilibrium", c.false_equilibrium},
          {"false_mechanism", c.false_mechanism},
          {"never_held", c.never_held},
          {"no_end", c.no_end},
          {"uncertified", c.uncertified},
          {"uncertified_least", uncertified.least},
          {"uncertified_most", uncertified.most}};
}

}  // namespace

std::string atlas_csv(const atlas& a) {
  std::string text;
  for (const atlas_cell& c : a.cells) {
    const json cell = cell_json(c);
    std::string names;
    std::string values;
    for (const auto& [name, value] : cell.items()) {
      names += (names.empty() ? "" : ",") + name;
      values += values.empty() ? "" : ",";
      values += value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
    }
    if (text.empty()) text = names + "\n";
    text += values + "\n";
  }
  return text;
}

std::string atlas_json(const atlas& a) {
  std::string text = fmt::format(
      "{{\n  \"format\": \"contct-atlas-1\",\n  \"problems\": {},\n  \"seed\": {},\n"
      "  \"wrong_beyond\": {},\n  \"cells\": [",
      a.request.problems, a.request.seed, json(wrong_beyond).dump());
  for (std::size_t i = 0; i < a.cells.size(); ++i)
    text += fmt::format("{}\n    {}", i == 0 ? "" : ",", cell_json(a.cells[i]).dump());
  return text + "\n  ]\n}\n";
}

}  // namespace contct
