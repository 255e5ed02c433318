// Tests problems on an external matrix, which must have the same answers as the native structure.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/exact_means.hpp"
#include "contct/read/problem_file.hpp"
#include "read/small_matrix.hpp"
#include "support/judged_run.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

const std::string structures = CONTCT_REFERENCE "/structures/";

/// Returns the problem with its structure as a matrix and its loads as forces at dofs.
problem by_matrix(const problem& p) {
  const int stride = dofs_per_node(p.geometry);
  problem m = on_matrix(entries_of(build(p.geometry, {}, {})), p.pairs, {});
  m.supports = p.supports;
  for (contact_pair& c : m.pairs) c.node *= stride;
  for (support& s : m.supports) s = {s.node * stride + s.dof, 0, s.fixed, s.spring};
  for (const load& l : p.steps) {
    const std::vector<double> f = nodal_loads(p.geometry, l).force;
    m.steps.emplace_back();
    for (std::size_t dof = 0; dof < f.size(); ++dof)
      if (f[dof] != 0.0) m.steps.back().points.push_back({static_cast<int>(dof), 0, f[dof]});
  }
  return m;
}

double largest(const std::vector<double>& u) {
  return std::abs(*std::ranges::max_element(u, {}, [](double x) { return std::abs(x); }));
}

void check_same(const judged_run& native, const judged_run& matrix) {
  const auto is_unique = [](const judged_run& r) {
    return std::ranges::all_of(r.steps, [](const auto& s) { return s.judged && s.judged->unique; });
  };
  CHECK(matrix.end.status == native.end.status);
  if (matrix.all_certified()) CHECK(native.all_certified());
  CHECK(is_unique(matrix) == is_unique(native));
  REQUIRE(matrix.seen.increments.size() == native.seen.increments.size());
  for (std::size_t i = 0; i < matrix.seen.increments.size(); ++i) {
    CHECK(matrix.share(i) == Approx(native.share(i)).epsilon(1e-12).margin(1e-12));
    CHECK(matrix.seen.increments[i].events == native.seen.increments[i].events);
  }
  double size = 0.0;
  for (const solved_step& step : native.steps) size = std::max(size, largest(step.displacement));
  REQUIRE(matrix.steps.size() == native.steps.size());
  for (std::size_t step = 1; step <= native.steps.size(); ++step) {
    CHECK(matrix.isep(step) == native.isep(step));
    std::vector<double> off = matrix.u(step);
    for (std::size_t dof = 0; dof < off.size(); ++dof) off[dof] -= native.u(step).at(dof);
    CHECK(largest(off) <= 1e-12 * size);
  }
}

/// The certificate of three dofs under a load at dof 3, which has a face below. `d`, `b`, `end`: the entries
/// on the diagonal, beside it, and at dof 3. `corner`: couples dofs 1 and 3; empty: no entry.
certificate certificate_of(const std::array<std::string, 4>& entries, const std::string& more,
                           const std::string& load) {
  const scratch_folder to;
  const auto& [d, b, end, corner] = entries;
  (void)to.write("K.mtx",
                 fmt::format("%%MatrixMarket matrix coordinate real symmetric\n3 3 6\n1 1 {0}\n2 1 {1}\n"
                             "2 2 {0}\n3 2 {1}\n3 3 {2}\n3 1 {3}\n",
                             d, b, end, corner.empty() ? "0" : corner));
  const problem p = parse_problem(
      fmt::format(
          "[matrix]\nstiffness = \"K.mtx\"\n{}[[contact]]\ndof = \"3\"\nsurface = \"below\"\nface = -0.15\n"
          "stiffness = 1000.0\n[[step]]\npoint = [{{ dof = \"3\", value = {} }}]\n",
          more, load),
      to.at("p.toml"));
  const linear_structure s = structure_of(p);
  const solved_path found = certifier(p, s, exact_means_of(p)).find_final_states();
  return found.steps.empty() ? certificate{} : found.steps[0].judged.value();
}

}  // namespace

TEST_CASE(
    "a beam or plate given by its matrix has the same events, displacements and certificates as without a "
    "matrix") {
  std::size_t events = 0;
  const auto compare = [&events](const std::string& name, bool without_supports) {
    INFO(name);
    problem native = read_problem(CONTCT_REFERENCE "/problems/" + name + ".toml");
    if (without_supports) native.supports.clear();
    const judged_run by_name(native, "fortran");
    const judged_run same(by_matrix(native), "fortran");
    check_same(by_name, same);
    events += by_name.seen.events().size();
    return same.all_certified();
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
  const beam_problem p{{{0, 1, 2, 3}, {5, 5, 5}},
                       {},
                       {{0, face_below, 0.0, 10.0, true}, {3, face_below, 0.0, 10.0, true}},
                       {tip_load(1, -1), tip_load(1, 1)}};
  const judged_run native(p.as_problem(), "fortran");
  CHECK(native.end.status == path_status::mechanism);
  check_same(native, judged_run(by_matrix(p.as_problem()), "fortran"));
}

TEST_CASE("frame.py writes the files of the reference frame, and all states of this problem are certified") {
  const scratch_folder here;
  REQUIRE(std::system(fmt::format("cd '{}' && python3 '{}frame.py'", here.at(""), structures).c_str()) == 0);
  for (const char* name : {"frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"}) {
    INFO(name);
    const std::string kept = read_input(structures + name);
    CHECK(here.read(name) == kept);
    CHECK(kept.size() > 50);
  }
  const problem p = read_problem(structures + "frame.toml");
  const judged_run r(p, "fortran");
  CHECK(r.end.status == path_status::solved);
  CHECK(r.all_certified());
  REQUIRE(r.steps.size() == 3);
  CHECK(r.seen.increments.size() == 7);
  // Supports and wall carry all forces to the right, and supports and prop carry all forces down.
  const std::vector<double>& u = r.u(2);
  const std::vector<double> held = reactions(p.geometry, p.steps[1], p.supports, u);
  REQUIRE(held.size() == 6);
  const auto pressed = [&](std::size_t i) { return force_of(p.pairs[i], u[p.pairs[i].node], true); };
  CHECK(held[0] + held[3] - pressed(1) == Approx(-8000).epsilon(1e-9));
  CHECK(held[1] + held[4] + pressed(0) == Approx(20000).epsilon(1e-9));

  // The same frame from CalculiX's files.
  std::string sti;
  for (const matrix_entry& e : std::get<assembled>(p.geometry.kind).stiffness.entries)
    sti += fmt::format("{} {}  {:.17e}\n", e.column + 1, e.row + 1, e.value);
  (void)here.write("frame.sti", sti);
  std::string toml = read_input(structures + "frame.toml");
  const std::size_t from = toml.find("[matrix]");
  toml.replace(from, toml.find("[[support]]") - from, "[calculix]\njob = \"frame\"\n");
  check_same(r, judged_run(read_problem(here.write("c.toml", toml)), "fortran"));
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
  const problem p = read_problem(structures + "frame.toml");
  const linear_structure s = structure_of(p);
  (void)follow(p, s, "refactor", *make_kernel("fortran"), {&watches});
  CHECK(watches.id == std::vector<int>{17, 22});  // 6.y and 8.x
  CHECK(watches.layout.ndofpn == 1);
  CHECK(watches.layout.indof == 1);
  CHECK(watches.dofs == 33);
}

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
