#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <tuple>
#include <utility>

#include "contct/linear/sparse_factor.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/tables.hpp"
#include "contct/structure/line.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/memory.hpp"
#include "contct/text/sha256.hpp"

namespace contct {
namespace {

// Two bands of this many entries take 8 GB.
constexpr std::int64_t most_band_entries = 500'000'000;
/// The largest size of a file of coordinates or of a mesh, in MiB. A million nodes take about 50 MiB.
constexpr std::size_t largest_mesh_file = 256;
constexpr real_range poisson{-1.0, false, "a number greater than -1 and at most 0.5", 0.5};

/// Reads coordinates, which must increase; `what` is the word for a coordinate in messages.
std::vector<double> read_coordinates(const toml_value& t, const char* key, const char* what) {
  std::vector<double> x = t[key].reals(any_real, 2);
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[i - 1]) continue;
    t[key].entries("", 2)[i].refuse(fmt::format("more than the {} before it, {}", what, x[i - 1]));
  }
  return x;
}

/// Reads a stiffness or section in pieces: each piece extends from the end of the piece before it to the node
/// at its `to`. read(piece, elements) reads the other `keys` of a piece.
template <class Read>
void read_pieces(const toml_value& pieces, const beam& b, std::vector<std::string_view> keys,
                 const Read& read) {
  int end = 0;
  const coordinate_row nodes = nodes_along(b);
  keys.insert(keys.begin(), "to");
  for (const toml_value& piece : pieces.tables()) {
    piece.allow_only(keys);
    const toml_value to = piece["to"];
    (void)to.required("the coordinate at which this piece ends");
    const int next = nodes.index_of(to);
    if (next <= end) to.refuse(fmt::format("more than {}, where this piece begins", b.x[end]));
    read(piece, next - end);
    end = next;
  }
  if (end < b.elements())
    pieces.refuse(fmt::format("pieces that end at {}", b.x[end]),
                  fmt::format("a last piece to {}, where the beam ends", b.x.back()));
}

/// All pieces must have an optional key or none may, because stresses, self-weight and shear are those of the
/// whole beam.
void add_section(const toml_value& t, int elements, beam& b) {
  beam_section s;
  for (const auto& [key, value, required] : section_keys) {
    if (required || t.has(key)) s.*value = t[key].real(positive_real);
    if (!b.sections.empty() && (b.sections.front().*value > 0.0) != t.has(key))
      t.refuse(fmt::format("{} in some pieces and not in others", key),
               fmt::format("{} in every piece, or in no piece", key));
  }
  if (t.has("G") != t.has("As"))
    t.refuse(t.has("G") ? "G without As" : "As without G", "both or neither: the shear stiffness is G As");
  b.sections.insert(b.sections.end(), elements, s);
  b.EI.insert(b.EI.end(), elements, product_of<double>(s.E, s.I));
  if (t.has("G")) b.GA.insert(b.GA.end(), elements, product_of<double>(s.G, s.As));
}

void read_sections(const toml_value& t, beam& b) {
  std::vector<std::string_view> keys;
  for (const section_key& key : section_keys) keys.push_back(key.name);
  for (const element_key& key : element_keys)
    t.refuse_beside({key.name}, "section", "either EI and GA, or section with E and I, and G and As");
  const toml_value section = t["section"];
  if (section.is_array())
    return read_pieces(section, b, keys, [&b](const auto& piece, int n) { add_section(piece, n, b); });
  section.table().allow_only(keys);
  add_section(section, b.elements(), b);
}

/// Reads the number of each element: one for all, one for each, or pieces.
std::vector<double> read_along(const toml_value& t, const char* key, const beam& b) {
  std::vector<double> all;
  if (has_pieces(t, key)) {
    read_pieces(t[key], b, {"value"}, [&all](const toml_value& piece, int n) {
      all.insert(all.end(), n, piece["value"].real(positive_real));
    });
    return all;
  }
  if (t.has("element_size") && t[key].is_array())
    t[key].refuse("one number, or pieces { to = .., value = .. }, because element_size sets the elements");
  return t[key].reals_for(positive_real, b.elements(), "element");
}

void read_stiffness(const toml_value& t, beam& b) {
  if (t.has("section")) return read_sections(t, b);
  for (const auto& [key, values, required] : element_keys)
    if (required || t.has(key)) b.*values = read_along(t, key, b);
}

bool are_normal(std::initializer_list<double> numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isnormal(x); });
}

/// Refuses an element whose stiffness is out of the range of doubles, although its length and EI are finite.
void check_elements(const toml_value& t, const beam& b) {
  for (int e = 0; e < b.elements(); ++e) {
    const double h = b.length_of(e);
    const double EI = b.EI[e];
    const double largest = 12 * EI / h / h / h;
    const double smallest = EI / h;
    if (!are_normal({h, largest, smallest}) || !std::isfinite(largest * h) || !std::isfinite(12 * smallest))
      t.refuse(fmt::format("element {} of length {:g} and EI = {:g}", e + 1, h, EI),
               "elements whose stiffness 12 EI / h^3 is within the range of double precision");
    if (!b.GA.empty() && !are_normal({b.GA[e] / h, 1 / b.GA[e], EI / b.GA[e] / h / h}))
      t.refuse(fmt::format("element {} of length {:g} with EI = {:g} and GA = {:g}", e + 1, h, EI, b.GA[e]),
               "elements for which EI / (GA h^2) is within the range of double precision");
  }
}

/// Reads the nodes of a beam. If the table has element_size, adds nodes between the coordinates of the table.
mesh_line read_nodes(const toml_value& t, const toml_value& top) {
  if (t.has("x"))
    t.refuse_beside({"length", "elements"}, "x",
                    "x with element_size or alone, or length with elements or element_size");
  if (t.has("element_size")) t.refuse_beside({"elements"}, "element_size", "either elements or element_size");
  if (!t.has("x") && !t.has("element_size")) {
    const double length = t["length"].real(positive_real);
    (void)t["elements"].required(fmt::format("a whole number from 1 to {}, or element_size", most_elements));
    return even_line(length, t["elements"].integer(1, most_elements));
  }
  std::vector<double> given = t.has("x") ? read_coordinates(t, "x", "node")
                                         : std::vector<double>{0.0, t["length"].real(positive_real)};
  if (t.has("element_size")) return sized_mesh(t, top, given);
  return {std::move(given), std::vector<even_run>{}};
}

beam read_beam(const toml_value& t, const toml_value& top) {
  std::vector<std::string_view> keys = {"x", "length", "elements", "element_size"};
  for (const element_key& key : element_keys) keys.emplace_back(key.name);
  keys.emplace_back("section");
  t.allow_only(keys);
  beam b;
  std::tie(b.x, b.runs) = read_nodes(t, top);
  read_stiffness(t, b);
  check_elements(t, b);
  return b;
}

/// Refuses a grid that is too large, before memory of its size is allocated.
void check_size(const toml_value& t, std::int64_t along_x, std::int64_t along_y) {
  constexpr double gigabyte = 1e9 / sizeof(double);
  const std::int64_t shorter = std::min(along_x, along_y);
  const std::int64_t longer = std::max(along_x, along_y);
  if (longer > most_elements || shorter * longer > most_elements)
    t.refuse(fmt::format("{} x {} elements", along_x, along_y),
             fmt::format("at most {} elements", most_elements));
  const std::int64_t entries = 3 * (shorter + 1) * (longer + 1) * (3 * (shorter + 2) + 3);
  if (entries > most_band_entries)
    t.refuse(fmt::format("{} x {} elements, whose stiffness matrix takes {:.1f} GB", along_x, along_y,
                         static_cast<double>(entries) / gigabyte),
             fmt::format("at most {:.1f} GB; the matrix grows with the square of the shorter side",
                         static_cast<double>(most_band_entries) / gigabyte));
}

void read_grid(const toml_value& t, plate& p) {
  if (t.has("x") || t.has("y")) {
    t.refuse_beside({"size", "elements"}, "x or y", "either x and y, or size and elements");
    p.x = read_coordinates(t, "x", "line");
    p.y = read_coordinates(t, "y", "line");
    check_size(t, p.x.size() - 1, p.y.size() - 1);
    return;
  }
  const std::vector<double> size = t["size"].reals(positive_real, 2);
  if (size.size() != 2) t["size"].refuse("two numbers: along x, along y");
  const auto counts = t["elements"].entries("two whole numbers: elements along x, along y", 2, 2);
  const int columns = counts[0].integer(1, most_elements);
  const int rows = counts[1].integer(1, most_elements);
  check_size(t, columns, rows);
  std::tie(p.x, p.x_runs) = even_line(size[0], columns);
  std::tie(p.y, p.y_runs) = even_line(size[1], rows);
}

void read_material(const toml_value& t, plate& p) {
  p.nu = t["nu"].real(poisson);
  if (t.has("D")) {
    t.refuse_beside({"E", "thickness"}, "D", "either D, or E and thickness");
    t.refuse_beside({"weight"}, "D", "weight together with E and thickness");
    p.D = t["D"].real(positive_real);
    return;
  }
  p.E = t["E"].real(positive_real);
  p.thickness = t["thickness"].real(positive_real);
  if (t.has("weight")) p.weight = t["weight"].real(positive_real);
  p.D = bending_stiffness(p.E, p.nu, p.thickness);
  if (!std::isnormal(p.D))
    t.refuse(fmt::format("E, nu and thickness that make D = {:g}", p.D),
             "D = E t^3 / 12 (1 - nu^2) within the range of double precision");
}

/// Refuses an element of a plate whose stiffness is out of the range of doubles: D b / a^3 along x or y, or
/// that of slopes or twist.
void check_elements(const toml_value& t, const plate& p) {
  const auto sound = [&](double a, double b) {
    const double along = p.D * b / a / a / a;
    return are_normal({a, along, p.D * b / a, p.D / a / b}) && std::isfinite(1000 * along) &&
           std::isfinite(1000 * along * a) && std::isfinite(1000 * p.D * b / a);
  };
  for (int e = 0; e < p.elements(); ++e) {
    const double width = p.width_of(e);
    const double height = p.height_of(e);
    if (!sound(width, height) || !sound(height, width))
      t.refuse(fmt::format("element {} of size {:g} x {:g} and D = {:g}", e + 1, width, height, p.D),
               "elements whose stiffness, such as D b / a^3, is within the range of double precision");
  }
}

plate read_plate(const toml_value& t) {
  t.allow_only({"x", "y", "size", "elements", "E", "nu", "thickness", "weight", "D"});
  plate p;
  read_grid(t, p);
  read_material(t, p);
  check_elements(t, p);
  return p;
}

/// The most bytes that a run needs at a time for the structure, an engine and the reference solution, with K
/// stored as a.as_band says. If K is sparse, CHOLMOD orders K for this estimate.
std::int64_t bytes_of_run(const assembled& a) {
  if (a.as_band) return 3 * bytes_of_band(a.stiffness, a.rows);
  // An engine also stores columns of the inverse, for which half a factor is enough.
  constexpr std::int64_t as_read = sizeof(matrix_entry);
  constexpr std::int64_t in_columns = sizeof(double) + sizeof(int);
  const auto entries = static_cast<std::int64_t>(a.stiffness.entries.size());
  return (as_read + 3 * in_columns) * entries + 5 * sparse_factor::make(columns_of(a.stiffness))->bytes() / 2;
}

/// "band" or "sparse"; empty if the table has no storage.
std::string read_storage(const toml_value& t) {
  if (!t.has("storage")) return "";
  constexpr const char* allowed = R"("band"; also "sparse" if CHOLMOD is built in)";
  std::string storage = t["storage"].text(allowed);
  if (storage != "band" && (storage != "sparse" || !sparse_factor::available()))
    t["storage"].refuse(in_quotes(storage) + (storage == "sparse" ? " without CHOLMOD" : ""), allowed);
  return storage;
}

/// Chooses the storage of K, before memory is allocated: without the key storage, a band, unless CHOLMOD is
/// built in and the band is too large or sparse factors take far less. Refuses more than memory_limit.
void choose_storage(const toml_value& t, assembled& a) {
  constexpr std::int64_t small_band = std::int64_t{256} << 20;
  constexpr std::int64_t far_less = 4;
  const std::string storage = read_storage(t);
  const std::int64_t limit = memory_limit();
  const std::int64_t band = bytes_of_run(a);
  a.as_band = storage == "band" ||
              (storage.empty() && (!sparse_factor::available() || band <= std::min(small_band, limit)));
  const std::int64_t needed = a.as_band ? band : bytes_of_run(a);
  a.as_band = a.as_band || (storage.empty() && band <= limit && band <= far_less * needed);
  if ((a.as_band ? band : needed) <= limit) return;
  const char* const remedy = sparse_factor::available() ? "storage = \"sparse\"; " : "build with CHOLMOD; ";
  t.refuse(
      fmt::format("{} dofs with a half bandwidth of {}, which take {}{}", a.dofs(),
                  subdiagonals_of(a.stiffness, a.rows), bytes_words(band),
                  a.as_band ? "" : fmt::format(", or {} in CHOLMOD's sparse factors", bytes_words(needed))),
      fmt::format("{}, three quarters of this machine's memory; {}condense the matrix onto the dofs "
                  "that have pairs and loads, or use a coarser model",
                  bytes_words(limit), a.as_band ? remedy : ""));
}

std::string shown_name(const std::string& path) {
  return printable(path, std::string::npos);
}

void read_labels(const std::string& path, assembled& a) {
  a.labels_from = shown_name(path);
  a.labels = parse_labels(read_input(path, "list of labels", largest_matrix_file), path);
}

/// Reads the positions of dofs by `parse` from the file at `path`. If the key `named` names the file, refuses
/// it if no label names one of its nodes: the file is of another structure.
template <class Parse>
void read_places(const toml_value& named, const std::string& path, const char* kind, const Parse& parse,
                 assembled& a) {
  a.places = parse(read_input(path, kind, largest_mesh_file), path, a);
  a.places.from = shown_name(path);
  if (a.places.known() || !named.is_there()) return;
  named.refuse(fmt::format("no node of {} that a label names; the first label is {}", a.places.from,
                           in_quotes(a.label_of(0))),
               "labels NODE.DIRECTION: the name of a node, a dot, and x, y, z, r, rx, ry, rz or 1 to 6");
}

assembled read_matrix(const toml_value& t, const named_files& files, std::vector<std::string>& warnings) {
  t.allow_only({"stiffness", "dofs", "coordinates", "free_motions", "storage"});
  assembled a;
  const std::string path = files.path_of(t["stiffness"]);
  a.name = shown_name(path);
  const std::string text = read_input(path, "stiffness matrix", largest_matrix_file);
  a.sha256 = sha256(text);
  a.stiffness = parse_symmetric(text, a.name, &warnings);
  if (t.has("dofs")) {
    read_labels(files.path_of(t["dofs"]), a);
    if (a.labels.size() != static_cast<std::size_t>(a.dofs()))
      t["dofs"].refuse(fmt::format("{} labels in {}", a.labels.size(), a.labels_from),
                       fmt::format("{}, one for each row of {}", a.dofs(), a.name));
  }
  if (t.has("coordinates"))
    read_places(t["coordinates"], files.path_of(t["coordinates"]), "file of coordinates",
                places_by_coordinates, a);
  return a;
}

assembled read_calculix(const toml_value& t, const named_files& files, std::vector<std::string>& warnings) {
  t.allow_only({"job", "mesh", "free_motions", "storage"});
  assembled a;
  const std::string path = files.path_of(t["job"], ".sti");
  a.name = shown_name(path);
  read_labels(files.path_of(t["job"], ".dof"), a);
  const std::string text = read_input(path, "stiffness matrix of CalculiX", largest_matrix_file);
  a.sha256 = sha256(text);
  a.stiffness = parse_calculix_stiffness(text, a.name, static_cast<int>(a.labels.size()), &warnings);
  // Without the key mesh, the mesh is the .inp file of the job if there is one.
  const toml_value named = t["mesh"];
  const std::string mesh = named.is_there() ? files.path_of(named) : files.path_of(t["job"], ".inp");
  if (named.is_there() || std::filesystem::exists(mesh))
    read_places(named, mesh, "input file of CalculiX", places_by_mesh, a);
  return a;
}

}  // namespace

void store_matrix(const toml_value& top, std::span<const contact_pair> pairs, assembled& a) {
  std::set<std::pair<int, int>> missing;  // row and column
  for (const contact_pair& c : pairs)
    if (c.other >= 0) missing.emplace(std::max(c.node, c.other), std::min(c.node, c.other));
  for (const matrix_entry& e : a.stiffness.entries) missing.erase({e.row, e.column});
  for (const auto& [row, column] : missing) a.stiffness.entries.push_back({row, column, 0.0});
  const toml_value t = top[top.has("matrix") ? "matrix" : "calculix"];
  if (t.has("free_motions")) a.free_motions = t["free_motions"].integer(0, most_rigid_motions);
  a.rows = rows_for_small_band(a.stiffness);
  choose_storage(t, a);
}

model read_model(const toml_value& top, const named_files& files, std::vector<std::string>& warnings) {
  const char* const allowed = "exactly one of [beam], [plate], [matrix] and [calculix]";
  const char* kind = nullptr;
  for (const char* other : {"beam", "plate", "matrix", "calculix"}) {
    if (!top.has(other)) continue;
    if (kind != nullptr) top.refuse_beside({other}, kind, allowed);
    kind = other;
  }
  if (top.has("beam")) return {read_beam(top["beam"].table(), top)};
  if (top.has("plate")) return {read_plate(top["plate"].table())};
  if (top.has("matrix")) return {read_matrix(top["matrix"].table(), files, warnings)};
  if (top.has("calculix")) return {read_calculix(top["calculix"].table(), files, warnings)};
  top.refuse("none of [beam], [plate], [matrix] and [calculix]", "exactly one of them");
}

}  // namespace contct
