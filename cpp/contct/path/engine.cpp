#include "contct/path/engine.hpp"

#include "contct/path/condensed_engine.hpp"
#include "contct/path/refactor_engine.hpp"
#include "contct/path/updated_engine.hpp"

namespace contct {

std::vector<std::string> engine_names() {
  return {"refactor", "updated", "condensed"};
}

void refuse_unknown_engine(std::string_view name) {
  std::string known;
  for (const std::string& n : engine_names()) {
    if (n == name) return;
    known += (known.empty() ? "" : ", ") + n;
  }
  throw std::invalid_argument("no engine is named \"" + std::string(name) + "\"; there are: " + known);
}

std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_structure& s) {
  refuse_unknown_engine(name);
  if (name == "condensed") return std::make_unique<condensed_engine>(s);
  if (name == "updated") return std::make_unique<updated_engine>(s);
  return std::make_unique<refactor_engine>(s);
}

}  // namespace contct
