// A libFuzzer program for every reader. The environment variable CONTCT_FUZZER has the name of a reader, as
// in targets.txt.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contct/kernel/trace.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/serve/serve.h"
#include "contct/text/input_text.hpp"
#include "read/good_problem.hpp"

#ifndef CONTCT_REFERENCE  // for clang-tidy, which has no build of the fuzzers
#define CONTCT_REFERENCE "reference"
#endif

using namespace contct;

namespace {

/// Ends the program unless `holds`, so that libFuzzer reports the input. The message has `words`, which is
/// the expectation, and `found`.
void require(bool holds, std::string_view words, std::string_view found = {}) {
  if (holds) return;
  (void)std::fprintf(stderr, "fuzzer: found otherwise: %.*s: %.*s\n", static_cast<int>(words.size()),
                     words.data(), static_cast<int>(found.size()), found.data());
  std::abort();
}

/// Calls `read`, and returns false if `read` refuses the input. A refusal must be an input_error of one line
/// with a limited length and without control characters. Any other exception ends the program.
bool is_read(const std::function<void()>& read) {
  constexpr std::size_t longest_message = 2000;
  try {
    read();
    return true;
  } catch (const input_error& e) {
    const std::string_view message(e.what());
    require(!message.empty(), "a refusal says why");
    require(message.size() <= longest_message, "a refusal is no longer than a message may be", message);
    // A missing file's name is escaped only when the message is printed.
    require(message.find("cannot be read") != std::string_view::npos ||
                std::ranges::none_of(message, [](char c) { return static_cast<unsigned char>(c) < 0x20; }),
            "a refusal has one line, without control characters", message);
    return false;
  }
}

/// Splits an input at the first line =====, for a reader of two files; the second part may be missing.
std::vector<std::string_view> parts_of(std::string_view text) {
  constexpr std::string_view marker = "\n=====\n";
  const std::size_t end = text.find(marker);
  if (end == std::string_view::npos) return {text};
  return {text.substr(0, end + 1), text.substr(end + marker.size())};
}

/// As is_read, for a reader that may give one warning for a file.
bool is_read_with_warning(const std::function<void(std::vector<std::string>*)>& read) {
  std::vector<std::string> warnings;
  const bool good = is_read([&] { read(&warnings); });
  require(warnings.size() <= 1, "one warning for a file");
  return good;
}

void require_lower_triangle(const sparse_matrix& m) {
  for (const matrix_entry& e : m.entries) {
    require(e.column >= 0 && e.column <= e.row && e.row < m.order, "an entry is in the lower triangle");
    require(std::isfinite(e.value) && (e.row != e.column || e.value > 0.0), "an entry is a number");
  }
}

/// Returns the file of a matrix. Every row has a diagonal entry, even if the entry is 0.
std::string written(const sparse_matrix& m) {
  std::string lines;
  std::vector<char> has_diagonal(m.order, 0);
  for (const matrix_entry& e : m.entries) {
    lines += fmt::format("{} {} {}\n", e.row + 1, e.column + 1, e.value);
    if (e.row == e.column) has_diagonal[e.row] = 1;
  }
  for (int row = 0; row < m.order; ++row)
    if (has_diagonal[row] == 0) lines += fmt::format("{0} {0} 0\n", row + 1);
  return fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n{2}", m.order,
                     std::ranges::count(lines, '\n'), lines);
}

/// A Matrix Market matrix or load vector. A matrix that is written must be read as the same matrix.
void fuzz_matrix_market(std::string_view text) {
  for (const int rows : {1, 3, 33}) {
    std::vector<double> values;
    if (!is_read_with_warning([&](auto* given) { values = parse_vector(text, "f.mtx", rows, given); }))
      continue;
    require(std::ssize(values) == rows, "a vector has a number for each row");
    require(std::ranges::all_of(values, [](double x) { return std::isfinite(x); }), "a load is a number");
  }
  sparse_matrix read;
  if (!is_read_with_warning([&](auto* given) { read = parse_symmetric(text, "k.mtx", given); })) return;
  require_lower_triangle(read);
  const auto place = [](const matrix_entry& e) { return std::pair(e.column, e.row); };
  require(std::ranges::adjacent_find(read.entries, std::greater_equal{}, place) == read.entries.end(),
          "entries are in the order of columns and rows");
  require(std::ranges::none_of(read.entries, [](const matrix_entry& e) { return e.value == 0.0; }), "no 0");
  const std::string again = written(read);
  require(is_read([&] {
            std::vector<std::string> none;
            require(written(parse_symmetric(again, "again.mtx", &none)) == again, "the same matrix", again);
            require(none.empty(), "the shortest decimals draw no warning", again);
          }),
          "a matrix that was written is read", again);
}

/// CalculiX's matrix and its labels: JOB.dof, a line =====, and JOB.sti.
void fuzz_calculix_matrix(std::string_view text) {
  const auto parts = parts_of(text);
  std::vector<std::string> labels;
  if (!is_read([&] { labels = parse_labels(parts[0], "job.dof"); }) || parts.size() < 2) return;
  require(std::set(labels.begin(), labels.end()).size() == labels.size(), "a label is of one dof");
  const int rows = static_cast<int>(labels.size());
  sparse_matrix k;
  if (!is_read_with_warning(
          [&](auto* given) { k = parse_calculix_stiffness(parts[1], "job.sti", rows, given); }))
    return;
  require(k.order == rows, "a row for each label");
  require_lower_triangle(k);
}

void require_nodes(const std::vector<placed_node>& nodes) {
  std::set<std::string> names;
  for (const placed_node& n : nodes) {
    require(names.insert(n.name).second, "a node is there once", n.name);
    for (const double x : n.at) require(std::isfinite(x), "a coordinate is a number", n.name);
  }
}

void require_edges(const placed_nodes& mesh) {
  for (const mesh_edge& e : mesh.edges)
    require(e.from >= 0 && e.from < e.to && e.to < std::ssize(mesh.nodes), "an edge joins two nodes");
}

/// The mesh in CalculiX's input file.
void fuzz_inp_mesh(std::string_view text) {
  assembled a;
  a.labels = {"1.x", "2.x", "12.3"};
  a.stiffness.order = 3;
  placed_nodes mesh;
  if (!is_read([&] { mesh = places_by_mesh(text, "job.inp", a); })) return;
  require_nodes(mesh.nodes);
  require_edges(mesh);
  std::set<std::pair<int, int>> edges;
  for (const mesh_edge& e : mesh.edges)
    require(e.elements > 0 && edges.emplace(e.from, e.to).second, "an edge is there once");
}

/// Coordinates, a line =====, and labels. The matrix couples each dof with the next dof.
void fuzz_coordinates(std::string_view text) {
  const auto parts = parts_of(text);
  if (!is_read([&] { require_nodes(parse_coordinates(parts[0], "k.xyz")); }) || parts.size() < 2) return;
  assembled chain;
  if (!is_read([&] { chain.labels = parse_labels(parts[1], "k.dof"); })) return;
  chain.stiffness.order = static_cast<int>(chain.labels.size());
  for (int i = 0; i < chain.stiffness.order; ++i) {
    if (i > 0) chain.stiffness.entries.push_back({i, i - 1, -1.0});
    chain.stiffness.entries.push_back({i, i, 2.0});
  }
  const placed_nodes places = places_by_coordinates(parts[0], "k.xyz", chain);
  require(!places.known() || places.dofs.size() == chain.labels.size(), "a place for each dof");
  for (const placed_dof& d : places.dofs)
    require(d.node >= -1 && d.node < std::ssize(places.nodes) && d.direction >= 0 && d.direction <= 6,
            "a dof's place");
  require_edges(places);
}

/// Checks the invariants of a problem on which its users rely.
void check(const problem& p) {
  require(nodes(p.geometry) > 0 && !p.steps.empty(), "a problem has nodes and steps");
  const auto is_dof = [&p](const auto& of) {
    return of.node >= 0 && of.node < nodes(p.geometry) && of.dof >= 0 && of.dof < dofs_per_node(p.geometry);
  };
  for (const contact_pair& c : p.pairs) {
    require(c.node >= 0 && c.node < nodes(p.geometry), "a pair is at a node");
    require(std::isfinite(c.face) && std::isfinite(c.stiffness) && c.stiffness > 0.0, "a pair's numbers");
    require(c.surface == 1 || c.surface == -1, "a pair's side");
  }
  for (const bed& b : p.beds)
    require(b.first_pair + b.share.size() <= p.pairs.size(), "a bed's pairs are there");
  for (const support& s : p.supports)
    require(is_dof(s) && (s.fixed || (std::isfinite(s.spring) && s.spring > 0.0)), "a fixed dof or a spring");
  for (const load& l : p.steps) {
    for (const point_load& f : l.points)
      require(is_dof(f) && std::isfinite(f.value), "a load is a number at a dof");
    for (const face_move& m : l.moves) {
      require(is_dof(m) && std::isfinite(m.factor * m.value), "a move is a number at a dof");
      const auto is_there = [&m](const contact_pair& c) { return c.node == m.node; };
      require(std::ranges::any_of(p.pairs, is_there), "a face that moves is that of a pair");
    }
    for (const prescribed_displacement& g : l.settlements) {
      require(is_dof(g) && std::isfinite(g.value), "a settlement is a number at a dof");
      const auto is_held = [&g](const support& s) { return s.fixed && s.node == g.node && s.dof == g.dof; };
      require(std::ranges::any_of(p.supports, is_held), "what settles is fixed");
    }
  }
}

/// A problem file, which may name the files of reference/structures.
void fuzz_problem_file(std::string_view text) {
  (void)is_read([&] { check(parse_problem(text, CONTCT_REFERENCE "/structures/problem.toml")); });
}

/// Reads a trace, checks it, and returns the text of the trace that was read.
std::string rewritten(std::string_view text) {
  constexpr std::size_t most_dofs = 100'000;  // in all calls together, for speed
  trace_reader reader(text, "f.trace");
  std::string again;
  append_header(reader.read_header(), again);
  recorded_call c;
  std::size_t dofs = 0;
  while (reader.next(c) && (dofs += c.in.dd.size()) < most_dofs) {
    for (std::size_t i = 0; i < c.in.pairs(); ++i)
      require(c.in.dof_of_pair(i) < c.in.dd.size(), "a pair is at a dof");
    require(c.out.ss.size() == c.in.pairs() && c.out.isep.size() == c.in.pairs(), "an answer has all pairs");
    append_call(c.answered(), c.note, again);
  }
  return again;
}

/// A trace. A trace that is written must be read as the same trace.
void fuzz_trace(std::string_view text) {
  std::string first;
  if (!is_read([&] { first = rewritten(text); })) return;
  require(is_read([&] { require(rewritten(first) == first, "a trace is written as it was read"); }),
          "a trace that was written is read", first);
}

/// The options of a function of the C interface: a line with the function's name, and then its options in
/// JSON.
void fuzz_serve(std::string_view text) {
  using function = char* (*)(const char*, const char*);
  constexpr std::array<std::pair<std::string_view, function>, 5> functions = {{{"run", contct_run},
                                                                               {"check", contct_check},
                                                                               {"exact", contct_exact},
                                                                               {"explain", contct_explain},
                                                                               {"certify", contct_certify}}};
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string options(text.substr(std::min(end + 1, text.size())));
  for (const char* part : {"\\", "pipe", "plugin"})  // these could make a command or a library a kernel
    if (options.find(part) != std::string::npos) return;
  for (const auto& [name, ask] : functions) {
    if (name != text.substr(0, end)) continue;
    char* const given = ask(good_problem, options.c_str());
    require(given != nullptr, "there is an answer");
    const std::string answer(given);  // NOLINT(clang-analyzer-cplusplus.StringChecker): see the line above
    contct_free(given);
    const auto read = nlohmann::json::parse(answer, nullptr, false);
    require(!read.is_discarded(), "an answer is JSON in UTF-8", answer);
    const int exit = read["exit"].get<int>();
    require(exit >= 0 && exit <= 5, "an answer has an exit status", answer);
    require(read["error"].is_null() == (exit != 2), "an error goes with exit 2", answer);
    require(exit == 2 || read["result"].is_object(), "an answer has a result", answer);
  }
}

using fuzzer = void (*)(std::string_view);

fuzzer chosen() {
  constexpr std::array<std::pair<std::string_view, fuzzer>, 7> fuzzers = {
      {{"problem_file", fuzz_problem_file},
       {"matrix_market", fuzz_matrix_market},
       {"calculix_matrix", fuzz_calculix_matrix},
       {"inp_mesh", fuzz_inp_mesh},
       {"coordinates", fuzz_coordinates},
       {"trace", fuzz_trace},
       {"serve", fuzz_serve}}};
  const char* const wanted = std::getenv("CONTCT_FUZZER");
  for (const auto& [name, fuzz] : fuzzers)
    if (wanted != nullptr && name == wanted) return fuzz;
  require(false, "CONTCT_FUZZER names a reader", wanted != nullptr ? wanted : "nothing");
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzzer fuzz = chosen();
  fuzz({reinterpret_cast<const char*>(data), size});
  return 0;
}
