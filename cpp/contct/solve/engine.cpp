#include "contct/solve/engine.hpp"

#include "contct/solve/cholmod_engine.hpp"
#include "contct/solve/condensed_engine.hpp"
#include "contct/solve/refactor_engine.hpp"
#include "contct/solve/updated_engine.hpp"
#include "contct/text/strings.hpp"

namespace contct::solve {

std::vector<std::string> engine_names() {
  std::vector<std::string> names = {"refactor", "updated", "condensed"};
  if (sparse_factor::available()) names.insert(names.end(), {"cholmod", "dissected"});
  return names;
}

std::string_view quickest_engine(const linear_structure& s) {
  if (!s.stiffness.is_band()) return "cholmod";
  if (condensed_engine::suits(s)) return "condensed";
  constexpr int wide = 128;  // subdiagonals from which CHOLMOD's order is quicker than the band
  return sparse_factor::available() && s.stiffness.band().subdiagonals() >= wide ? "dissected" : "updated";
}

void refuse_unknown_engine(std::string_view name) {
  std::string known;
  for (const std::string& n : engine_names()) {
    if (n == name) return;
    known += (known.empty() ? "" : ", ") + n;
  }
  throw std::invalid_argument("no engine is named \"" + std::string(name) + "\"" +
                              did_you_mean(name, engine_names()) + "; there are: " + known);
}

std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_structure& s) {
  refuse_unknown_engine(name);
  if (name == "condensed") return std::make_unique<condensed_engine>(s);
  if (name == "cholmod") return std::make_unique<cholmod_engine>(s);
  if (name == "dissected") return std::make_unique<updated_engine>(s, true);
  if (name == "refactor") return std::make_unique<refactor_engine>(s);
  if (!s.stiffness.is_band())
    throw std::invalid_argument(
        "engine \"updated\": found a stiffness that is not stored as a band; allowed: refactor, cholmod or "
        "dissected");
  return std::make_unique<updated_engine>(s);
}

}  // namespace contct::solve
