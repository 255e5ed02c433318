#include "contct/path/engine.hpp"

#include "contct/path/refactor_engine.hpp"

namespace contct {

std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_structure& s) {
  if (name == "refactor") return std::make_unique<refactor_engine>(s);
  throw std::invalid_argument("no engine is named \"" + std::string(name) + "\"; there is: refactor");
}

std::vector<std::string> engine_names() {
  return {"refactor"};
}

}  // namespace contct
