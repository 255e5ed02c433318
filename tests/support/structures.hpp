// Problems of reference/structures, for tests that run in any folder.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contct/text/input_text.hpp"

namespace contct {

/// Returns the text of a problem file with full paths of the named files. Replaces each first text of
/// `replaced` by the second; throws std::invalid_argument if the file does not contain the first text.
inline std::string structure_problem(const std::string& folder, const std::string& name,
                                     const std::vector<std::pair<std::string, std::string>>& replaced = {}) {
  const std::string structures = CONTCT_REFERENCE "/structures/";
  std::string text = read_input(structures + folder + name + ".toml");
  const auto put = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  for (const auto& [from, to] : replaced) {
    if (text.find(from) == std::string::npos) throw std::invalid_argument(name + " has no " + from);
    put(from, to);
  }
  for (const char* file : {"frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"})
    put(std::string("\"") + file, "\"" + structures + folder + file);
  put("job = \"", "job = \"" + structures + folder);
  return text;
}

/// Return the problem of the portal frame, with and without the coordinates of its nodes.
inline std::string portal_frame() {
  return structure_problem("", "frame");
}
inline std::string frame_without_coordinates() {
  return structure_problem("", "frame", {{"coordinates = \"frame.xyz\"", ""}});
}

}  // namespace contct
