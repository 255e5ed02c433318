// Tests what is read of correct files, which accepted.txt lists, and the messages about the mistakes of
// refused.txt.
#include "contct/read/problem_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <functional>

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "contct/linear/sparse_factor.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/tables.hpp"
#include "contct/structure/acting.hpp"
#include "read/good_problem.hpp"
#include "read/small_matrix.hpp"
#include "support/rows.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;

namespace {

std::string words_of(const nodal_value& v, const model& m) {
  return fmt::format("{} {} {}{}", v.node + 1, dof_names(m)[v.dof], v.value,
                     v.factor == 1 ? "" : fmt::format(" * {}", v.factor));
}

/// Returns the loads, settlements and placed loads of a step, with elements, nodes and grid lines from 1.
std::string words_of(const load& l, const model& m) {
  std::vector<std::string> all;
  for (const point_load& p : l.points) all.push_back(words_of(p, m));
  for (const distributed_load& d : l.distributed) {
    std::vector<int> on;
    for (const int e : d.elements) on.push_back(e + 1);
    all.push_back(fmt::format("on {}: {}", on.empty() ? "all" : fmt::format("{}", fmt::join(on, " ")),
                              fmt::join(d.polynomial, " ")));
    if (d.parts.empty()) continue;
    all.back() += " exactly";
    for (const rational& a : coefficients_of(d)) all.back() += " " + fraction_words(a);
  }
  for (const prescribed_displacement& s : l.settlements) all.push_back("settles " + words_of(s, m));
  constexpr const char* kinds[] = {"force", "point", "moment", "curvature"};
  const auto* const on_beam = std::get_if<beam>(&m.kind);
  const auto* const on_plate = std::get_if<plate>(&m.kind);
  const auto from_to = [](const line<rational>& along, const line_place& from, const line_place& to) {
    return fraction_words(along.place(from)) + " to " + fraction_words(along.place(to));
  };
  for (const placed_load& p : l.placed) {
    const line<rational> along = on_beam != nullptr ? line<rational>(on_beam->x, on_beam->runs)
                                                    : line<rational>(on_plate->x, on_plate->x_runs);
    all.push_back(fmt::format("{} {}: {}", kinds[static_cast<int>(p.what)], from_to(along, p.from, p.to),
                              fmt::join(p.polynomial, " ")));
    if (on_plate != nullptr)
      all.back() += " across " + from_to({on_plate->y, on_plate->y_runs}, p.across[0], p.across[1]);
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

/// Returns what was read, as lines "key: value".
std::vector<std::string> words_of(const problem& p) {
  std::vector<std::string> lines;
  const auto add = [&lines](const std::string& key, const auto& values, const char* between = ", ") {
    lines.push_back(fmt::format("{}:{}{}", key, values.empty() ? "" : " ", fmt::join(values, between)));
  };
  using words = std::vector<std::string>;
  words supports, pairs, beds, names;
  for (const support& s : p.supports)
    supports.push_back(fmt::format("{} {}{}", s.node + 1, dof_names(p.geometry)[s.dof],
                                   s.fixed ? "" : fmt::format(" spring {}", s.spring)));
  for (const contact_pair& c : p.pairs)
    pairs.push_back(fmt::format("{} {} {} {} {}", c.node + 1, c.surface == face_above ? "above" : "below",
                                c.face, c.stiffness, c.closed ? "touching" : "separated"));
  for (const bed& b : p.beds)
    beds.push_back(fmt::format("{} from pair {}: {}", b.modulus, b.first_pair + 1, fmt::join(b.share, " ")));
  for (const load& l : p.steps)
    if (!l.name.empty()) names.push_back(l.name);
  add("nodes", words{std::to_string(nodes(p.geometry))});
  add("supports", supports);
  add("pairs", pairs);
  add("beds", beds);
  add("names", names);
  add("named", words{fmt::format("{}; {}; {}", fmt::join(p.names.supports, " "),
                                 fmt::join(p.names.pairs, " "), fmt::join(p.names.beds, " "))});
  words watched;
  for (const watched_part& w : p.watches)
    watched.push_back(fmt::format("{} from {} {} to {} {} {}", w.name, w.from[0], w.from[1], w.to[0], w.to[1],
                                  fmt::join(w.names, " ")));
  add("watched", watched);
  add("units", p.units.length.empty() ? words{} : words{p.units.length, p.units.force}, " ");
  add("warnings", p.warnings, " / ");
  add("number of warnings", words{std::to_string(p.warnings.size())});
  for (std::size_t step = 0; step < p.steps.size(); ++step) {
    const load& l = p.steps[step];
    const std::string acting = words_of(l, p.geometry);
    add(fmt::format("load {}", step + 1), acting.empty() ? words{} : words{acting});
    words terms;
    for (const load_term& t : l.terms)
      terms.push_back(fmt::format("{} {}{}", t.name, t.factor, t.at ? fmt::format(" at {}", *t.at) : ""));
    lines.push_back(
        fmt::format("terms {}: {}{}", step + 1, l.from_zero ? "from zero " : "", fmt::join(terms, ", ")));
  }
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) {
    std::vector<int> hinges;
    for (const int node : b->hinges) hinges.push_back(node + 1);
    add("x", b->x, " ");
    add("EI", b->EI, " ");
    add("GA", b->GA, " ");
    add("hinges", hinges, " ");
    add("of stiffness", b->hinge_stiffness, " ");
  } else if (const auto* q = std::get_if<plate>(&p.geometry.kind)) {
    add("x", q->x, " ");
    add("y", q->y, " ");
    add("D", words{fmt::format("{:.15g}", q->D)});
    add("nu", words{fmt::format("{}", q->nu)});
  } else if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) {
    words labels;
    for (int dof = 0; dof < a->dofs(); ++dof) labels.push_back(a->label_of(dof));
    add("labels", labels, " ");
    add("storage", words{a->as_band ? "band" : "sparse"});
    add("free motions", words{a->free_motions ? std::to_string(*a->free_motions) : "unknown"});
    const placed_nodes& at = a->places;
    lines.push_back(fmt::format("places: {} nodes, {} edges", at.nodes.size(), at.edges.size()));
    for (const placed_dof& dof : at.dofs)
      lines.back() +=
          dof.node < 0 ? ", none" : fmt::format(", {}.{}", at.nodes[dof.node].name, dof.direction);
    add("notes", at.notes);
  }
  return lines;
}

/// Returns the message about a problem on a matrix, without the names of folders.
std::string message_about(const std::string& text, const scratch_folder& here) {
  std::string message = "accepted";
  try {
    (void)structure_of(parse_problem(text, here.at("pb.toml")));
  } catch (const std::exception& e) {
    message = e.what();
  }
  const std::string folder = here.path().string() + "/";
  for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
    message.erase(at, folder.size());
  return message;
}

std::string message_of_text(const std::string& text) {
  return verdict([&] { (void)parse_problem(text, "pb.toml"); });
}

}  // namespace

TEST_CASE("of every file of accepted.txt, the reader gives the parts that the table lists") {
  const scratch_folder here;
  write_matrix_files(here);
  const std::string bare = "[beam]\nlength = 1\nelements = 1\nEI = 1\n[[step]]\nuniform = -1\n";
  const auto rows = rows_of(
      "read/accepted.txt",
      {{"beam", good_problem}, {"bare", bare}, {"plate", good_plate}, {"matrix", good_matrix_problem}});
  CHECK(rows.size() > 60);
  for (const table_row& row : rows) {
    INFO(row.fact << "\n" << row.row);
    std::vector<std::string> lines;
    CHECK_NOTHROW(
        lines = words_of(parse_problem(row.text, row.base == "matrix" ? here.at("pb.toml") : "pb.toml")));
    for (const std::string& expected : split(row.expected, " | ")) {
      const std::string key = expected.substr(0, expected.find(':') + 1);
      const auto found = std::ranges::find_if(lines, [&](const auto& l) { return l.starts_with(key); });
      std::string words = found == lines.end() ? "nothing" : *found;
      if (const auto at = words.find(here.path().string() + "/"); at != std::string::npos)
        words.erase(at, here.path().string().size() + 1);
      INFO(words);
      CHECK((expected.find(" ..") == std::string::npos ? words == expected : has_in_order(words, expected)));
    }
  }
}

TEST_CASE("with element_size, 2,000,000 elements are accepted, but not one more") {
  const auto sized = [](const std::string& size) {
    return verdict([&] {
      (void)parse_problem(
          "[beam]\nlength = 2000000\nelement_size = " + size + "\nEI = 1\n[[step]]\nuniform = -1\n",
          "pb.toml");
    });
  };
  CHECK(sized("1") == "accepted");
  CHECK_THAT(sized("0.9999999"), Contains("which makes 2000001 elements"));
}

TEST_CASE(
    "the largest plate that is accepted has a stiffness matrix of 4 GB, and a larger plate is refused") {
  const auto square = [](int n) {
    return verdict([&] {
      const auto document = parse_toml(
          fmt::format("[plate]\nsize = [1, 1]\nelements = [{}, {}]\nD = 1\nnu = 0\n", n, n), "m.toml");
      std::vector<std::string> warnings;
      (void)read_model(toml_value(document, "m.toml"), {"m.toml", reach::own_folder}, warnings);
    });
  };
  // The band has 3 (n + 1)^2 rows of 3 (n + 2) + 3 entries.
  const auto entries = [](std::int64_t n) { return 3 * (n + 1) * (n + 1) * (3 * (n + 2) + 3); };
  int n = 1;
  while (entries(n + 1) <= 500'000'000) ++n;
  CHECK(square(n) == "accepted");
  CHECK_THAT(square(n + 1), Contains("whose stiffness matrix takes 4.0 GB"));
}

TEST_CASE("each mistake of refused.txt is refused with place, what was found and what is allowed") {
  const scratch_folder here;
  write_matrix_files(here);
  const auto no_places = [] {
    assembled a;
    a.labels = {"1.x"};
    a.stiffness.order = 1;
    return a;
  };
  using reader = std::function<void(const std::string&)>;
  const std::map<std::string, std::pair<std::string, reader>> kinds = {
      {"beam", {good_problem, [](auto& text) { (void)parse_problem(text, "pb.toml"); }}},
      {"plate", {good_plate, [](auto& text) { (void)parse_problem(text, "pb.toml"); }}},
      {"matrix", {good_matrix_problem, {}}},
      {"K.mtx", {small_matrix, [](auto& text) { (void)parse_symmetric(text, "K.mtx"); }}},
      {"f.mtx", {small_vector, [](auto& text) { (void)parse_vector(text, "f.mtx", 3); }}},
      {"s.mtx", {small_sparse_vector, [](auto& text) { (void)parse_vector(text, "s.mtx", 3); }}},
      {"job.sti", {small_job, [](auto& text) { (void)parse_calculix_stiffness(text, "job.sti", 2); }}},
      {"K.dof", {"5.1\n5.2\n", [](auto& text) { (void)parse_labels(text, "K.dof"); }}},
      {"K.xyz", {small_places, [](auto& text) { (void)parse_coordinates(text, "K.xyz"); }}},
      {"job.inp", {small_mesh, [&](auto& text) { (void)places_by_mesh(text, "job.inp", no_places()); }}}};
  std::map<std::string, std::string> bases;
  for (const auto& [name, base_and_reader] : kinds) {
    const auto& base = base_and_reader.first;
    const auto& read = base_and_reader.second;
    bases[name] = base;
    INFO(name);
    CHECK((name == "matrix" ? message_about(base, here) : verdict([&] { read(base); })) == "accepted");
  }
  const auto rows = rows_of("read/refused.txt", bases);
  REQUIRE(rows.size() > 250);
  for (const table_row& row : rows) {
    const std::string message = row.base == "matrix" ? message_about(row.text, here)
                                                     : verdict([&] { kinds.at(row.base).second(row.text); });
    INFO(row.base << ": " << row.row << "\n" << message);
    CHECK(has_in_order(message, row.expected));
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < 450);
  }
}

TEST_CASE("a binary file, a deeply nested file and an empty file are refused with a message") {
  std::string dotted = "a";
  for (int i = 0; i < 300000; ++i) dotted += ".a";
  for (const std::string& text : {std::string("\x7f\x45LF\x02\x01\x01\x00\x00\x00\x00", 11),
                                  std::string(200000, '['), "x = " + std::string(100000, '['), std::string(),
                                  std::string("\xff\xfe"), std::string(1000, '\0'), dotted + " = 1\n"})
    CHECK(message_of_text(text) != "accepted");
  CHECK(message_of_text("[beam") ==
        "pb.toml:1:6: not TOML: found the end of the file; allowed: the rest of this table header");
}

TEST_CASE("a message quotes no long word or line, and says that a file may be cut short") {
  const auto of_matrix = [](const std::string& text) {
    return verdict([&] { (void)parse_symmetric(text, "K.mtx"); });
  };
  const std::string long_word = changed(small_matrix, "4 2 1 -1\x1b[31m" + std::string(5000, 'x'));
  CHECK_THAT(of_matrix(long_word), Contains("K.mtx:4: found a word of 5007 bytes for an entry"));
  CHECK_THAT(of_matrix(changed(small_matrix, "1 root:$6$secret:19000:0:99999:7:::")),
             Contains("K.mtx:1: found a line of 33 bytes"));
  const std::string cut =
      " without a line end: the file may be cut short; allowed: a line end after every line";
  CHECK(of_matrix(std::string(small_matrix, std::strlen(small_matrix) - 1)) ==
        "K.mtx:7: found \"3 3 1\"" + cut);
  CHECK(verdict([] { (void)parse_coordinates(small_places + std::string("c 1 2"), "K.xyz"); }) ==
        "K.xyz:5: found a line of 5 bytes" + cut);
  CHECK(verdict([] { (void)places_by_mesh(small_mesh + std::string("7,1,2,3"), "job.inp", assembled()); }) ==
        "job.inp:6: found \"7,1,2,3\"" + cut);
  CHECK_THAT(verdict([] { (void)parse_labels(std::string(101, 'n') + "\n", "K.dof"); }),
             Contains("K.dof:1: found a word of 101 bytes; allowed: ") && Contains("at most 100 bytes"));
  CHECK_THAT(verdict([] {
               (void)places_by_mesh(small_mesh + std::string("7,1\0,2,3\n", 9), "job.inp", assembled());
             }),
             Contains("job.inp:6: found a byte with the value 0; allowed: a text file"));
}

TEST_CASE(
    "a matrix whose band exceeds the memory is refused before allocation, but is accepted in sparse "
    "storage") {
  const scratch_folder here;
  // The last row of this matrix is full in any order of rows.
  constexpr int n = 400'000;
  std::string arrow =
      fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{} {} {}\n", n, n, 2 * n - 1);
  for (int i = 1; i < n; ++i) arrow += fmt::format("{} {} 2\n{} {} -1e-6\n", i, i, n, i);
  (void)here.write("arrow.mtx", arrow + fmt::format("{} {} 2\n", n, n));
  const auto message_with = [&](const std::string& key) {
    return verdict([&] {
      (void)parse_problem("[matrix]\nstiffness = \"arrow.mtx\"\n" + key +
                              "[[step]]\npoint = [ { dof = \"1\", value = 1 } ]\n",
                          here.at("p.toml"));
    });
  };
  const bool has_sparse = sparse_factor::available();
  const auto is_refused = [&](const std::string& message) {
    CHECK(has_in_order(
        message.substr(here.path().string().size() + 1),
        "p.toml:1:1: matrix: found 400000 dofs with a half bandwidth of .. GiB, three quarters of this "
        "machine's memory; " +
            std::string(has_sparse ? "storage = \"sparse\"" : "build with CHOLMOD") + "; condense"));
  };
  is_refused(message_with("storage = \"band\"\n"));
  if (has_sparse)  // sparse storage has few entries and no fill-in
    CHECK(message_with("") == "accepted");
  else
    is_refused(message_with(""));
}
