#include "app/grid_files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "contct/session/path_states.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

constexpr const char* vtu_collection = "--vtu (its collection)";
constexpr const char* vtu_increments = "--vtu (its increments)";

}  // namespace

std::string beside(const std::string& file, const std::string& end) {
  const fs::path path(file);
  return (path.parent_path() / (path.stem().string() + end)).string();
}

void add_grid_files(const std::string& vtu, std::vector<output_option>& all) {
  if (fs::path(vtu).extension() != ".vtu")
    throw std::invalid_argument(fmt::format("--vtu: found \"{}\"; allowed: a file that ends in .vtu", vtu));
  all.push_back({"--vtu", vtu});
  all.push_back({vtu_collection, beside(vtu, ".pvd")});
  for (std::size_t i = 0; i < most_pictures; ++i)
    all.push_back({vtu_increments, beside(vtu, name_of_state("", i)), true});
}

void check_grid_coordinates(const problem& p) {
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a == nullptr) return;
  if (!a->places.known())
    throw std::invalid_argument(fmt::format(
        "--vtu: found a structure given by its matrix, {}, without coordinates; allowed: one with "
        "coordinates, by coordinates = \"FILE\" in [matrix] or CalculiX's mesh, JOB.inp beside its matrix or "
        "mesh = \"FILE\" in [calculix]. --csv and --json have all its numbers, by label",
        a->name));
  const auto lost =
      std::ranges::count_if(p.pairs, [a](const contact_pair& c) { return a->places.dofs[c.node].node < 0; });
  if (lost > 0)
    complain("warning: --vtu: {} of {} pairs {} no cell: the places of their dofs are not known", lost,
             p.pairs.size(), lost == 1 ? "has" : "have");
}

/// The collection last: whoever sees it finds all that it names.
void write_grids(const output_files& files, const std::string& vtu, const run_result& r) {
  const std::vector<structure_state> states = pictures_of(r);
  for (std::size_t i = 0; i < states.size(); ++i) {
    output_file file(beside(vtu, name_of_state("", i)));
    file.write(vtu_of_state(r.what, states[i]));
    file.finish();
  }
  files.write("--vtu", vtu_of_state(r.what, states.back()));
  files.write(vtu_collection, pvd_of_states(fs::path(vtu).stem().string(), states.size()));
}

}  // namespace contct
