// Tests problems on an external matrix, which must have the same answers as the native structure, and their
// refusals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/session/run.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/result_json.hpp"
#include "read/refusals.hpp"
#include "read/small_matrix.hpp"
#include "support/matrices.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
namespace fs = std::filesystem;

namespace {

const fs::path reference = CONTCT_REFERENCE;

std::string text_of(const sparse_matrix& a) {
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{} {} {}\n", a.order,
                                 a.order, a.entries.size());
  for (const matrix_entry& e : a.entries) text += fmt::format("{} {} {}\n", e.row + 1, e.column + 1, e.value);
  return text;
}

std::string text_of(std::span<const double> f) {
  std::string text = fmt::format("%%MatrixMarket matrix array real general\n{} 1\n", f.size());
  for (const double value : f) text += fmt::format("{}\n", value);
  return text;
}

/// Returns the label "node.dof", counted from 1.
std::string label(int dof, int dofs_per_node) {
  return fmt::format("{}.{}", dof / dofs_per_node + 1, dof % dofs_per_node + 1);
}

/// Writes a problem with its structure as a matrix and its loads as vectors, and returns the file's name.
std::string exported(const problem& p, const scratch_folder& to) {
  const int stride = dofs_per_node(p.geometry);
  const sparse_matrix k = entries_of(build(p.geometry, {}, {}));
  (void)to.write("K.mtx", text_of(k));
  std::string labels;
  for (int dof = 0; dof < k.order; ++dof) labels += label(dof, stride) + "\n";
  (void)to.write("K.dof", labels);
  std::string text = "[matrix]\nstiffness = \"K.mtx\"\ndofs = \"K.dof\"\n";
  for (const support& s : p.supports) {
    text += fmt::format("[[support]]\ndof = \"{}\"\n{}\n", label(s.node * stride + s.dof, stride),
                        s.fixed ? "fix = true" : fmt::format("spring = {}", s.spring));
  }
  for (const contact_pair& c : p.pairs) {
    text += fmt::format(
        "[[contact]]\ndof = \"{}\"\nsurface = \"{}\"\nface = {}\nstiffness = {}\nstate = \"{}\"\n",
        label(c.node * stride, stride), surface_name(c.surface), c.face, c.stiffness,
        c.closed ? "contact" : "separated");
  }
  for (std::size_t step = 0; step < p.steps.size(); ++step) {
    std::vector<double> f(k.order, 0.0);
    add_consistent_loads(p.geometry, p.steps[step], f);
    (void)to.write(fmt::format("f{}.mtx", step), text_of(f));
    text += fmt::format("[[step]]\nload = \"f{}.mtx\"\n", step);
  }
  return to.write("problem.toml", text);
}

/// A problem, and its path by FORTRAN with C++ in lockstep.
struct followed {
  explicit followed(problem p)
      : what(std::move(p)),
        structure(structure_of(what)),
        path(what, structure, {.kernels = {"fortran", "cpp"}, .engine = "refactor"}) {
    path.go({});
  }

  [[nodiscard]] const std::vector<step_record>& steps() const { return path.result.record.steps; }
  [[nodiscard]] bool certified() const { return path.result.judged.all_certified(); }
  [[nodiscard]] bool unique() const {
    return std::ranges::all_of(path.result.judged.steps(), [](const auto& c) { return c && c->unique; });
  }

  const problem what;
  const linear_structure structure;
  run path;
};

double largest(const std::vector<double>& u) {
  double most = 0.0;
  for (const double x : u) most = std::max(most, std::abs(x));
  return most;
}

void check_same(const followed& native, const followed& matrix) {
  CHECK(matrix.path.result.compared->calls() > 0);
  CHECK(matrix.path.result.equal);
  CHECK(matrix.path.result.end.status == native.path.result.end.status);
  if (matrix.certified()) CHECK(native.certified());
  CHECK(matrix.unique() == native.unique());
  double size = 0.0;
  for (const step_record& step : native.steps()) size = std::max(size, largest(step.end.displacement));
  REQUIRE(matrix.steps().size() == native.steps().size());
  for (std::size_t step = 0; step < native.steps().size(); ++step) {
    const step_record& a = native.steps()[step];
    const step_record& b = matrix.steps()[step];
    REQUIRE(b.increments.size() == a.increments.size());
    for (std::size_t i = 0; i < a.increments.size(); ++i) {
      CHECK(b.increments[i].fraction == Approx(a.increments[i].fraction).epsilon(1e-12).margin(1e-12));
      CHECK(b.increments[i].events == a.increments[i].events);
    }
    CHECK(b.end.isep == a.end.isep);
    std::vector<double> off = b.end.displacement;
    for (std::size_t dof = 0; dof < off.size(); ++dof) off[dof] -= a.end.displacement.at(dof);
    CHECK(largest(off) <= 1e-12 * size);
  }
}

std::string message_of_structure(const std::string& path) {
  try {
    (void)structure_of(read_problem(path));
  } catch (const std::exception& e) {
    return e.what();
  }
  return "accepted";
}

const std::string small_problem =
    "[matrix]\n"                                    // 1
    "stiffness = \"K.mtx\"\n"                       // 2
    "dofs = \"K.dof\"\n"                            // 3
    "[[support]]\n"                                 // 4
    "dof = \"a\"\n"                                 // 5
    "spring = 2.0\n"                                // 6
    "[[contact]]\n"                                 // 7
    "dof = \"c\"\n"                                 // 8
    "surface = \"below\"\n"                         // 9
    "face = -0.5\n"                                 // 10
    "stiffness = 10.0\n"                            // 11
    "[[step]]\n"                                    // 12
    "point = [ { dof = \"c\", value = -3.0 } ]\n";  // 13

std::string small_with(const std::string& piece, const std::string& mistake) {
  std::string text = small_problem;
  return text.replace(text.find(piece), piece.size(), mistake);
}

}  // namespace

TEST_CASE(
    "a beam or plate given by its matrix has the same events, displacements and certificates as without a "
    "matrix") {
  std::size_t events = 0;
  const auto compare = [&events](const std::string& name, bool without_supports) {
    INFO(name);
    problem native = read_problem((reference / "problems" / (name + ".toml")).string());
    if (without_supports) native.supports.clear();
    const scratch_folder here;
    const followed by_name(native);
    const followed by_matrix(read_problem(exported(native, here)));
    check_same(by_name, by_matrix);
    for (const step_record& step : by_name.steps())
      for (const increment_record& i : step.increments) events += i.events.size();
    return by_matrix.certified();
  };
  for (const char* name :
       {"pb01-cantilever-tip-stop", "pb02-beam-over-cantilever", "pb06-settled-middle-support",
        "pb07-three-gap-supports", "pb10-cantilever-gapped-spring", "pp01a-simply-supported-plate-n4",
        "pp01e-unilateral-edges-n8-k1e5", "pp03d-corners-and-settled-stop-n4"})
    (void)compare(name, false);
  CHECK(events >= 12);
  // These structures have no supports. The first K, rounded to doubles, is not quite semidefinite, and
  // FORTRAN has only 6 digits of pb11a.
  CHECK_FALSE(compare("pb03a-point-load-on-bed-l4", true));
  CHECK(compare("pb04c-end-loads-on-bed-long", true));
  CHECK_FALSE(compare("pb11a-strip-footing-n20", true));
  CHECK(compare("pp03a-corner-supported-plate-n4", false));
}

TEST_CASE("a beam that is lifted off both faces is a mechanism, also if the beam is given by its matrix") {
  problem p;
  p.geometry.kind = beam{{0, 1, 2, 3}, {5, 5, 5}};
  p.pairs = {{0, face_below, 0.0, 10.0, true}, {3, face_below, 0.0, 10.0, true}};
  p.steps = {load{{{1, 0, -1.0}}, {}}, load{{{1, 0, 1.0}}, {}}};
  const scratch_folder here;
  const followed native(p);
  CHECK(native.path.result.end.status == path_status::mechanism);
  check_same(native, followed(read_problem(exported(p, here))));
}

TEST_CASE("frame.py writes the files of the reference frame, and all states of this problem are certified") {
  const fs::path frame = reference / "structures";
  const scratch_folder here;
  const std::string command =
      fmt::format("cd '{}' && python3 '{}'", here.path().string(), (frame / "frame.py").string());
  REQUIRE(std::system(command.c_str()) == 0);
  for (const char* name : {"frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"}) {
    INFO(name);
    std::ostringstream kept;
    kept << std::ifstream(frame / name, std::ios::binary).rdbuf();
    CHECK(here.read(name) == kept.str());
    CHECK(kept.str().size() > 50);
  }
  const problem p = read_problem((frame / "frame.toml").string());
  const followed r(p);
  CHECK(r.path.exit() == exit_status::solved);
  CHECK(r.certified());
  REQUIRE(r.steps().size() == 3);
  std::size_t increments = 0;
  for (const step_record& step : r.steps()) increments += step.increments.size();
  CHECK(increments == 7);
  // Supports and wall carry all forces to the right, and supports and prop carry all forces down.
  const std::vector<double>& u = r.steps()[1].end.displacement;
  const std::vector<double> held = reactions(p.geometry, p.steps[1], p.supports, u);
  REQUIRE(held.size() == 6);
  const auto pressed = [&](std::size_t i) { return force_of(p.pairs[i], u[p.pairs[i].node], true); };
  CHECK(held[0] + held[3] - pressed(1) == Approx(-8000).epsilon(1e-9));
  CHECK(held[1] + held[4] + pressed(0) == Approx(20000).epsilon(1e-9));
}

TEST_CASE("a frame read from CalculiX's files equals the same frame read from Matrix Market files") {
  const fs::path frame = reference / "structures";
  const scratch_folder here;
  const problem p = read_problem((frame / "frame.toml").string());
  const sparse_matrix& k = std::get<assembled>(p.geometry.kind).stiffness;
  std::string sti;
  for (const matrix_entry& e : k.entries)
    sti += fmt::format("{} {}  {:.17e}\n", e.column + 1, e.row + 1, e.value);
  (void)here.write("frame.sti", sti);
  fs::copy_file(frame / "frame.dof", here.path() / "frame.dof");
  fs::copy_file(frame / "wind.mtx", here.path() / "wind.mtx");
  std::ostringstream text;
  text << std::ifstream(frame / "frame.toml").rdbuf();
  std::string toml = text.str();
  const std::size_t from = toml.find("[matrix]");
  toml.replace(from, toml.find("[[support]]") - from, "[calculix]\njob = \"frame\"\n");
  check_same(followed(p), followed(read_problem(here.write("c.toml", toml))));
}

TEST_CASE(
    "a problem on a matrix may have springs, lists of dofs, and a load from a file together with point "
    "loads") {
  const scratch_folder here;
  (void)here.write("K.mtx", small_matrix);
  (void)here.write("K.dof", "a\nb\nc\n");
  (void)here.write("f.mtx", text_of(std::vector<double>{0, 1, -2}));
  const problem p = read_problem(here.write(
      "p.toml",
      small_with("dof = \"a\"", "dofs = [\"a\", \"b\"]") +
          "[[step]]\nload = \"f.mtx\"\npoint = [ { dof = \"b\", value = 4 } ]\n[[contact]]\ndof = "
          "\"b\"\nsurface = \"above\"\nface = 0\nstiffness = 1\n[[support]]\ndof = \"b\"\nfix = true\n"));
  REQUIRE(p.supports.size() == 3);
  CHECK(p.supports[1].node == 1);
  CHECK(p.supports[1].spring == 2.0);
  CHECK(p.supports[2].fixed);
  REQUIRE(p.pairs.size() == 2);
  CHECK(p.pairs[1].closed);
  REQUIRE(p.warnings.size() == 1);
  CHECK_THAT(p.warnings[0], Catch::Matchers::Contains("contact[2]: dof b is fixed"));
  std::vector<double> f(3, 0.0);
  add_consistent_loads(p.geometry, p.steps[1], f);
  CHECK(f == std::vector<double>{0, 5, -2});
}

TEST_CASE("on a matrix, the listing gets NDOFPN = INDOF = 1, so that ID is the number of the dof") {
  struct watcher final : observer {
    void called(const answered_call& c) override {
      id.assign(c.c.id.begin(), c.c.id.end());
      layout = c.c.dof;
      dofs = c.c.dd.size();
    }
    std::vector<int> id;
    dof_layout layout{};
    std::size_t dofs = 0;
  } watches;
  const problem p = read_problem((reference / "structures" / "frame.toml").string());
  const linear_structure s = structure_of(p);
  (void)follow(p, s, "refactor", *make_kernel("fortran"), {&watches});
  CHECK(watches.id == std::vector<int>{17, 22});  // 6.y and 8.x
  CHECK(watches.layout.ndofpn == 1);
  CHECK(watches.layout.indof == 1);
  CHECK(watches.dofs == 33);
}

TEST_CASE("the result on a matrix names dofs by labels, and the list w has all displacements") {
  const followed r(read_problem((reference / "structures" / "frame.toml").string()));
  std::string text;
  output_file file(&text);
  write_result(r.path.result, file);
  CHECK_THAT(text, Catch::Matchers::Contains(R"({"pair":1,"dof":"6.y","surface":"below","state":)"));
  CHECK_THAT(text, Catch::Matchers::Contains(R"({"pair":1,"dof":"6.y","surface":"below","change":"make"})"));
  CHECK_THAT(text, Catch::Matchers::Contains(R"({"dof":"9.r","value":)"));
  CHECK_THAT(text, Catch::Matchers::Contains(R"("point":[{"dof":"6.y","value":)"));
  CHECK(text.find("\"node\"") > text.find("\"nodes\""));  // "node" is only in the list of nodes
  const auto list_after = [&text](const std::string& key) {
    const std::size_t from = text.find(key) + key.size();
    return text.substr(from, text.find(']', from) - from);
  };
  CHECK(list_after("\"w\": [") == list_after("\"displacement\": ["));
  CHECK(list_after("\"w\": [").size() > 100);
}

TEST_CASE("a mistake in a problem on a matrix is refused with place, what was found and what is allowed") {
  const scratch_folder here;
  (void)here.write("K.mtx", small_matrix);
  (void)here.write("K.dof", "a\nb\nc\n");
  (void)here.write("two.dof", "a\nb\n");
  (void)here.write("K.xyz", "a 0 0\n");
  (void)here.write("f.mtx", "%%MatrixMarket matrix array real general\n2 1\n1\n1\n");
  const std::vector<bad_file> all = {
      {"[matrix]\nstiffness = \"K.mtx\"\n[beam]\nlength = 1\n", "p.toml:1:1: matrix",
       "this key together with beam", "exactly one of"},
      {small_with("stiffness = \"K.mtx\"", ""), "p.toml:1:1: matrix.stiffness", "missing", "text"},
      {small_with("K.mtx", "none.mtx"), "none.mtx: cannot be read", "No such file", ""},
      {small_with("K.dof", "two.dof"), "p.toml:3:8: matrix.dofs", "2 labels in", "3, one for each row"},
      {small_with("dofs = \"K.dof\"\n", "labels = \"K.dof\"\n"), "p.toml:3:1: matrix.labels", "unknown",
       "stiffness, dofs, coordinates"},
      {small_with("[[support]]", "coordinates = \"K.xyz\"\n[[support]]"), "p.toml:4:15: matrix.coordinates",
       "no node of", "labels NODE.DIRECTION"},
      {small_with("[[support]]", "mesh = \"K.xyz\"\n[[support]]"), "p.toml:4:1: matrix.mesh", "unknown",
       "stiffness, dofs"},
      {small_with("[[support]]", "free_motions = 7\n[[support]]"), "p.toml:4:16: matrix.free_motions", "7",
       "from 0 to 6"},
      {small_with("dof = \"a\"", "dof = \"1\""), "p.toml:5:7: support[1].dof", "\"1\"", "a label of"},
      {small_with("dof = \"a\"", "node = 1"), "p.toml:5:1: support[1].node", "unknown",
       "dof, dofs, fix, spring"},
      {small_with("spring = 2.0", "spring = 2.0\nfix = true"), "p.toml:4:1: support[1]",
       "both fix and spring", "one of them"},
      {small_with("spring = 2.0", ""), "p.toml:4:1: support[1]", "neither fix nor spring", "one of them"},
      {small_with("spring = 2.0", "fix = false"), "p.toml:6:7: support[1].fix", "false", "true"},
      {small_with("[matrix]\n", "[matrix]\nstorage = \"skyline\"\n"), "p.toml:2:11: matrix.storage",
       "\"skyline\"", "\"band\"; also \"sparse\""},
      {small_with("[[step]]", "[[bed]]\nmodulus = 1\n[[step]]"), "p.toml:12:1: bed", "a bed with a matrix",
       "[[contact]]"},
      {small_with("point = [ { dof = \"c\", value = -3.0 } ]", "uniform = 1"), "p.toml:13:1: step[1].uniform",
       "unknown", "load, point"},
      {small_with("point = [ { dof = \"c\", value = -3.0 } ]", ""), "p.toml:12:1: step[1]",
       "without a load, settlement or move", "at least one of load, point"},
      {small_with("point = [ { dof = \"c\", value = -3.0 } ]", "load = \"f.mtx\""), "f.mtx:2", "2 rows",
       "3, as in the matrix"},
      {small_with("face = -0.5\n", "face = -0.5\nother = \"c\"\n"), "p.toml:11:9: contact[1].other",
       "dof c, which is also the pair's dof", "another dof"},
      {small_with("face = -0.5\n", "face = -0.5\nother = \"bb\"\n"), "p.toml:11:9: contact[1].other",
       "\"bb\"", "a label of"},
      {small_with("face = -0.5\n", "face = -0.5\nother = [\"a\", \"b\"]\n"), "p.toml:11:9: contact[1].other",
       "2 labels", "1, or 1: one for each pair"},
      {small_with("spring = 2.0\n[[contact]]\n", "fix = true\n[[contact]]\nother = \"a\"\n"),
       "p.toml:8:9: contact[1].other", "dof a, which a support fixes", "omit the key other"},
      {small_with("point = [ { dof = \"c\", value = -3.0 } ]", "move = [ { dof = \"a\", value = 1 } ]"),
       "p.toml:13:10: step[1].move[1]", "no pair at dof a", "[[contact]]"},
      {small_with("face = -0.5\n", "face = -0.5\nother = \"b\"\n") +
           "move = [ { dof = \"b\", value = 1 } ]\n",
       "p.toml:15:10: step[1].move[1]", R"(dof b, which is "other" of a pair)",
       R"(exchange "dof" and "other")"},
      {small_with("value = -3.0 }", "value = 1e308 }, { dof = \"a\", value = 1e308 }"),
       "p.toml:12:1: step[1]", "sum or moment is not finite", "double"},
  };
  for (const bad_file& b : all) {
    const std::string message = message_of_structure(here.write("p.toml", b.text));
    INFO(b.text << "\n" << message);
    CHECK_THAT(message, Catch::Matchers::Contains(b.place));
    CHECK_THAT(message, Catch::Matchers::Contains(b.found));
    CHECK_THAT(message, Catch::Matchers::Contains(b.allowed));
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(message_of_structure(here.write("p.toml", small_problem)) == "accepted");
  CHECK_THAT(
      message_of_structure(here.write("c.toml", "[calculix]\njob = \"none\"\n[[step]]\nload = \"f.mtx\"\n")),
      Catch::Matchers::Contains("none.dof: cannot be read"));
}

TEST_CASE("a label that no dof has is refused, and the message suggests the nearest label") {
  const scratch_folder here;
  (void)here.write("K.mtx", small_matrix);
  (void)here.write("K.dof", "185.1\n185.2\n212.3\n");
  const std::string message = message_of_structure(
      here.write("p.toml",
                 "[matrix]\nstiffness = \"K.mtx\"\ndofs = \"K.dof\"\n[[contact]]\ndof = \"185.1\"\n"
                 "other = \"212.33\"\nsurface = \"below\"\nface = 0\nstiffness = 1\n[[step]]\n"));
  CHECK_THAT(message, Catch::Matchers::Contains("found \"212.33\" (did you mean \"212.3\"?)"));
}

TEST_CASE(
    "a matrix that is not positive semidefinite is refused, and the message names the file of the matrix") {
  const scratch_folder here;
  (void)here.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 2\n2 2 1\n");
  const std::string message = message_of_structure(here.write(
      "p.toml", "[matrix]\nstiffness = \"K.mtx\"\n[[step]]\npoint = [ { dof = \"1\", value = 1 } ]\n"));
  CHECK_THAT(message, Catch::Matchers::Contains("K.mtx: the matrix is not positive semidefinite"));
  CHECK_THAT(message, Catch::Matchers::Contains("allowed: no eigenvalue below -1e-10"));
}

namespace {

/// The certificate of three dofs under a load at dof 3, which has a face below. `d`, `b`, `end`: the entries
/// on the diagonal, beside it, and at dof 3. `corner`: couples dofs 1 and 3; empty: no entry.
certificate certificate_of(const std::array<std::string, 4>& entries, const std::string& more,
                           const std::string& load) {
  const scratch_folder to;
  const auto& [d, b, end, corner] = entries;
  const std::string last = corner.empty() ? "" : "3 1 " + corner + "\n";
  (void)to.write(
      "K.mtx", fmt::format("%%MatrixMarket matrix coordinate real symmetric\n3 3 {}\n1 1 {}\n2 1 {}\n2 2 {}\n"
                           "3 2 {}\n3 3 {}\n{}",
                           corner.empty() ? 5 : 6, d, b, d, b, end, last));
  const problem p = read_problem(to.write(
      "p.toml",
      "[matrix]\nstiffness = \"K.mtx\"\n" + more +
          "[[contact]]\ndof = \"3\"\nsurface = \"below\"\nface = -0.15\nstiffness = 1000.0\n[[step]]\n"
          "point = [{ dof = \"3\", value = " +
          load + " }]\n"));
  const linear_structure s = structure_of(p);
  certifier judged(p, s, contct::exact_means_of(p));
  observer* const watching[] = {&judged};
  (void)judged.find_final_states(watching);
  return judged.steps().empty() ? certificate{} : judged.steps()[0].value_or(certificate{});
}

}  // namespace

TEST_CASE("the entries of a matrix are the decimals of its file, whatever their form, and are certified") {
  const std::array<std::string, 4> all[] = {
      {"200", "-100", "100"}, {"2e2", "-1e2", "1e2"}, {"2.0", "-1.0", "2.0"},       {"2E+00", "-1.", "2.000"},
      {"0.2", "-0.1", "0.1"}, {"0.2", "-0.1", "0.2"}, {"2.4E5", "-1.2E5", "1.2E5"}, {"20e-2", "-.1", "0.1"}};
  for (const auto& entries : all) {
    INFO(entries[0] << " " << entries[1] << " " << entries[2]);
    CHECK(certificate_of(entries, "", "-10").certified);
  }
}

TEST_CASE(
    "if only rounding holds a matrix, the reason has the rigid-body motions, and free_motions is a remedy") {
  using Catch::Matchers::Contains;
  const std::string two = "0.6666666666666666";
  const std::string soft = "0.6666666666666667";
  const std::string third = "-0.3333333333333333";
  const std::string declared = "free_motions = 1\n";
  // Thirds that are rounded up leave the stiffness 1e-16, which the face or nothing but rounding may support.
  CHECK(certificate_of({soft, third, soft, third}, "", "-10").certified);
  CHECK_THAT(
      certificate_of({soft, third, soft, third}, "", "10").problem,
      Contains("1 motion is nearly free: its stiffness is") && Contains("set free_motions = 1, or 0 if"));
  CHECK(certificate_of({soft, third, soft, third}, "free_motions = 0\n", "10").certified);
  // Entries that are rounded down make the matrix indefinite.
  for (const std::string& down : {two, std::string("0.66666666666")}) {
    const certificate indefinite = certificate_of({down, "-0.3333333333333334", down, third}, "", "-10");
    CHECK_FALSE(indefinite.certified);
    CHECK_THAT(indefinite.problem, Contains("1 motion is nearly free: its stiffness is -") &&
                                       Contains("of the largest; set free_motions = 1"));
    CHECK(certificate_of({down, "-0.3333333333333334", down, third}, declared, "-10").certified);
  }
  CHECK_THROWS_WITH(certificate_of({"0.666", "-0.33301", "0.666", "-0.333"}, "", "-10"),
                    Contains("1 motion is nearly free: set free_motions = 1"));
  CHECK(certificate_of({"0.666", "-0.33301", "0.666", "-0.333"}, declared, "-10").certified);
}
