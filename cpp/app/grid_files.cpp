#include "app/grid_files.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "contct/distributed/ranks.hpp"

namespace contct::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* vtu_collection = "--vtu (its collection)";
constexpr const char* vtu_increments = "--vtu (its increments)";
constexpr const char* vtu_pieces = "--vtu (its pieces)";

/// One for each rank of the MPI job, as long as so many files can be open at once.
std::size_t pieces_of_grid() {
  constexpr std::size_t most_open = 256;
  const distributed::ranks* const all = distributed::joined_ranks();
  return all == nullptr ? 1 : std::min(static_cast<std::size_t>(all->count()), most_open);
}

/// The collection last: whoever sees it finds all that it names.
void write_each(const output_files& files, const std::string& vtu, const finished_run& r) {
  const auto& frames = r.kept.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    output_file file(beside(vtu, name_of_frame("", i)));
    file.write(vtu_of_frame(r.what, frames[i]));
    file.finish();
  }
  files.write("--vtu", vtu_of_frame(r.what, frames.back()));
  files.write(vtu_collection, pvd_of_frames(fs::path(vtu).stem().string(), frames.size()));
}

/// All are written before any gets its name, so that a full disk leaves none. The file that lists the pieces
/// is named last: whoever sees it finds them.
void write_pieces(const output_files& files, const std::string& vtu, const finished_run& r) {
  const std::size_t count = pieces_of_grid();
  const grid_pieces all = pieces_of_frame(r.what, r.kept.frames().back(), count);
  std::vector<std::unique_ptr<output_file>> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    pieces.push_back(std::make_unique<output_file>(beside(vtu, name_of_piece("", i))));
    pieces.back()->write(all.piece(i));
    pieces.back()->flush();
  }
  output_file& list = *files["--vtu"];
  list.write(all.index(fs::path(vtu).stem().string()));
  list.flush();
  for (const auto& piece : pieces) piece->finish();
  list.finish();
}

}  // namespace

std::string beside(const std::string& file, const std::string& end) {
  const fs::path path(file);
  return (path.parent_path() / (path.stem().string() + end)).string();
}

bool is_in_pieces(const std::string& vtu) {
  return fs::path(vtu).extension() == ".pvtu";
}

void add_grid_files(const std::string& vtu, const std::string& engine, std::vector<output_option>& all) {
  const bool in_pieces = is_in_pieces(vtu) && engine == "petsc";
  if (!in_pieces && fs::path(vtu).extension() != ".vtu")
    throw std::invalid_argument(fmt::format(
        "--vtu: found \"{}\"; allowed: a file that ends in .vtu, or with --engine petsc in .pvtu", vtu));
  all.push_back({"--vtu", vtu});
  if (in_pieces) {
    for (std::size_t i = 0; i < pieces_of_grid(); ++i)
      all.push_back({vtu_pieces, beside(vtu, name_of_piece("", i)), true});
    return;
  }
  all.push_back({vtu_collection, beside(vtu, ".pvd")});
  for (std::size_t i = 0; i < frame_limits{}.most_frames; ++i)
    all.push_back({vtu_increments, beside(vtu, name_of_frame("", i)), true});
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

void write_grids(const output_files& files, const std::string& vtu, const finished_run& r) {
  (is_in_pieces(vtu) ? write_pieces : write_each)(files, vtu, r);
}

}  // namespace contct::app
