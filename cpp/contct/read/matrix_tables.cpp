#include "contct/read/matrix_tables.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "contct/matrix/bandwidth.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/read/dof_labels.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/matrix_places.hpp"
#include "contct/read/memory_limit.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {
namespace {

std::string bytes_words(std::int64_t bytes) {
  constexpr double mib = 1 << 20;
  constexpr double gib = 1 << 30;
  const auto amount = static_cast<double>(bytes);
  if (amount >= gib) return fmt::format("{:.1f} GiB", amount / gib);
  return amount >= 10 * mib ? fmt::format("{:.0f} MiB", amount / mib)
                            : fmt::format("{:.1f} MiB", amount / mib);
}

/// What a run takes beyond what there may be, and what to do about it.
[[noreturn]] void refuse_too_large(const table_reader& t, const assembled& a, const std::string& takes,
                                   const std::string& remedy) {
  t.refuse(fmt::format("{} dofs with {}", a.dofs(), takes),
           fmt::format("{} (CONTCT_MEMORY_MIB in the environment sets another limit); {}condense the matrix "
                       "onto the dofs that have pairs and loads, or use a coarser model",
                       bytes_words(memory_limit()), remedy));
}

/// Bytes that a run holds at its largest, K as it is stored: the structure's, an engine's and the reference
/// solution's. Where K is sparse, CHOLMOD finds an ordering for it.
std::int64_t bytes_of_run(const assembled& a) {
  if (a.as_band) return 3 * bytes_of_band(a.stiffness, a.rows);
  // An engine's factor that is updated takes half as much again as the reference solution's.
  constexpr std::int64_t as_read = sizeof(matrix_entry);
  constexpr std::int64_t in_columns = sizeof(double) + sizeof(int);
  const auto entries = static_cast<std::int64_t>(a.stiffness.entries.size());
  return (as_read + 3 * in_columns) * entries + 5 * sparse_factor::make(columns_of(a.stiffness))->bytes() / 2;
}

/// "band", "sparse", or nothing where the table does not say.
std::string read_storage(const table_reader& t) {
  if (!t.has("storage")) return "";
  constexpr const char* allowed = R"("band", or "sparse" where CHOLMOD is built in)";
  std::string said(t.text_of(t.required("storage", allowed), "storage", allowed));
  if (said != "band" && (said != "sparse" || !sparse_factor::available()))
    t.refuse_key("storage", contct::text::in_quotes(said) + (said == "sparse" ? " without CHOLMOD" : ""),
                 allowed);
  return said;
}

/// A band, unless CHOLMOD is built in and the band is too large, or so wide that sparse factors take far
/// less. Decided before any of it is allocated.
void choose_storage(const table_reader& t, assembled& a) {
  constexpr std::int64_t small_band = std::int64_t{256} << 20;
  constexpr std::int64_t far_less = 4;
  const std::string said = read_storage(t);
  const std::int64_t limit = memory_limit();
  const std::int64_t band = bytes_of_run(a);
  const bool may_be_sparse = said != "band" && sparse_factor::available();
  if (said != "sparse" && band <= limit && (!may_be_sparse || band <= small_band)) return;
  const std::string band_takes = fmt::format("a half bandwidth of {}, which take {}",
                                             subdiagonals_of(a.stiffness, a.rows), bytes_words(band));
  if (!may_be_sparse && band > limit)
    refuse_too_large(t, a, band_takes,
                     sparse_factor::available() ? "storage = \"sparse\"; " : "build with CHOLMOD; ");
  a.as_band = false;
  const std::int64_t sparse = bytes_of_run(a);
  if (said != "sparse" && band <= limit) a.as_band = band <= far_less * sparse;
  if (!a.as_band && sparse > limit)
    refuse_too_large(
        t, a, fmt::format("{}, or {} in CHOLMOD's sparse factors", band_takes, bytes_words(sparse)), "");
}

std::vector<std::string> read_labels(const std::string& path) {
  return parse_labels(read_input(path, "list of labels", largest_matrix_file), path);
}

/// The keys that both tables have, and the ordering.
void finish(const table_reader& t, assembled& a) {
  if (t.has("free_motions")) a.free_motions = t.integer("free_motions", 0, most_rigid_motions);
  a.rows = rows_for_small_band(a.stiffness);
  choose_storage(t, a);
}

/// Refuse a file that has none of the nodes: it belongs to another structure.
void refuse_unknown_nodes(const table_reader& t, std::string_view key, const std::string& path,
                          const assembled& a) {
  if (a.places.known()) return;
  t.refuse_key(
      key, fmt::format("no node in {} of any label, as {}", path, contct::text::in_quotes(a.label_of(0))),
      "nodes by what stands before the last dot of labels, and behind it x, y, z, r, rx, ry, rz or 1 to 6");
}

/// The mesh that the table names, or else the one beside the job's matrix, where there is one.
void find_mesh(const table_reader& t, const std::string& folder, const std::string& job, assembled& a) {
  const std::string path = t.has("mesh") ? beside(folder, t.text("mesh")) : job + ".inp";
  if (!t.has("mesh") && !std::filesystem::exists(path)) return;
  a.places = places_from_inp(path, a);
  if (t.has("mesh")) refuse_unknown_nodes(t, "mesh", path, a);
}

}  // namespace

std::string beside(const std::string& folder, const std::string& name) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  return path == "-" ? "./-" : path;  // a file of that name: standard input holds the problem, if anything
}

assembled read_matrix(const table_reader& t, const std::string& folder) {
  t.allow_only({"stiffness", "dofs", "coordinates", "free_motions", "storage"});
  assembled a;
  a.name = beside(folder, t.text("stiffness"));
  a.stiffness = parse_symmetric(read_input(a.name, "Matrix Market file", largest_matrix_file), a.name);
  if (t.has("dofs")) {
    a.labels_from = beside(folder, t.text("dofs"));
    a.labels = read_labels(a.labels_from);
    if (a.labels.size() != static_cast<std::size_t>(a.dofs()))
      t.refuse_key("dofs", fmt::format("{} labels in {}", a.labels.size(), a.labels_from),
                   fmt::format("{}, one for each row of {}", a.dofs(), a.name));
  }
  finish(t, a);
  if (t.has("coordinates")) {
    const std::string path = beside(folder, t.text("coordinates"));
    a.places = places_from_coordinates(path, a);
    refuse_unknown_nodes(t, "coordinates", path, a);
  }
  return a;
}

assembled read_calculix(const table_reader& t, const std::string& folder) {
  t.allow_only({"job", "mesh", "free_motions", "storage"});
  const std::string job = beside(folder, t.text("job"));
  assembled a;
  a.name = job + ".sti";
  a.labels_from = job + ".dof";
  a.labels = read_labels(a.labels_from);
  a.stiffness =
      parse_calculix_stiffness(read_input(a.name, "stiffness matrix of CalculiX", largest_matrix_file),
                               a.name, static_cast<int>(a.labels.size()));
  finish(t, a);
  find_mesh(t, folder, job, a);
  return a;
}

}  // namespace contct::read
