// Tests the text and the JSON of an exact path.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/outputs.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using contct::scratch_folder;

namespace {

using exact_json = nlohmann::ordered_json;

struct followed_exactly {
  explicit followed_exactly(const problem& p)
      : what(p), exactly(exact_problem_of(p)), path(follow_corrected_path(exactly)) {}

  [[nodiscard]] exact_run result() const { return {what, exactly, path, kernels}; }
  [[nodiscard]] exact_json document() const {
    const scratch_folder dir;
    const std::string file = (dir.path() / "exact.json").string();
    output_file out(file);
    write_exact_json(result(), out);
    return exact_json::parse(contct::read_input(file));
  }

  problem what;
  exact_problem exactly;
  exact_path path;
  std::vector<kernel_digits> kernels;
};

problem reference(const std::string& name) {
  return contct::read_problem(CONTCT_REFERENCE "/problems/" + name + ".toml");
}

const std::string falling =
    "[beam]\nx = [0, 1, 2]\nEI = 1\n[[contact]]\nnode = 1\nsurface = \"below\"\nface = -1\nstiffness = 1\n"
    "[[step]]\npoint = [ { node = 2, w = -2 } ]\n";

}  // namespace

TEST_CASE("the printed exact path has every event with the exact share and load") {
  const std::string text =
      exact_text(followed_exactly(reference("pb07-three-gap-supports")).result(), 20, {});
  CHECK_THAT(text, Contains("\nstep 2\n  share 3/38, load -2400/19: pair 1 (node 5, below) makes contact, "
                            "pair 3 (node 13, below) makes contact\n  share 1, load -200\n"));
  CHECK_THAT(text, Contains("  largest w -1664/160625 at node 9\n"));
  CHECK_THAT(text, Contains("  pair 1 (node 5, below): w -927/128500, force 31200/257\n"));
  CHECK_THAT(text, Contains("  pair 2 (node 9, below): w -2/375, gap 7/1500\n"));
}

TEST_CASE(
    "the printed exact path shows long fractions as decimals, and gives only the count of pairs if there are "
    "many") {
  const followed_exactly run(reference("pb03a-point-load-on-bed-l4"));
  const std::string text = exact_text(run.result(), 6, {});
  CHECK_THAT(text, Contains(" of 41 pairs in contact\n") && !Contains("/"));
}

TEST_CASE(
    "the printed exact path has a line for each kernel with correct digits and the first different event") {
  followed_exactly run(reference("pb01-cantilever-tip-stop"));
  run.kernels = {{"fortran", true, "", 15.4, 15.1, 14.0, 2},
                 {"mine", false, "exactly, so; here otherwise", 3, 2, 1, 1},
                 {"early", false, "the path ends early", 16, 16, 16, 0}};
  const std::string text = exact_text(run.result(), 20, {});
  CHECK_THAT(text,
             Contains("\nfortran: 15.4 digits of displacements, 14.0 of forces, 15.1 of the events' shares; "
                      "the same events\n"));
  CHECK_THAT(text, Contains("other events: exactly, so; here otherwise\n"));
  CHECK_THAT(text, Contains("\nearly: no end of a step to compare; other events: the path ends early\n"));
  const exact_json kernels = run.document()["kernels"];
  CHECK(kernels[0] == exact_json{{"name", "fortran"},
                                 {"same_events", true},
                                 {"first_difference", nullptr},
                                 {"digits", 15.4},
                                 {"event_digits", 15.1},
                                 {"force_digits", 14.0}});
  CHECK(kernels[1]["first_difference"] == "exactly, so; here otherwise");
  CHECK(kernels[1]["digits"] == 3.0);
  CHECK(kernels[2]["digits"].is_null());
  CHECK(kernels[2]["force_digits"].is_null());
}

TEST_CASE("the JSON output of an exact path has every number as a fraction") {
  const exact_json d = followed_exactly(reference("pb01-cantilever-tip-stop")).document();
  CHECK(d["format"] == "contct-exact-1");
  CHECK(d["status"] == "solved");
  const exact_json& step = d["steps"][1];
  CHECK(step["step"] == 2);
  CHECK(step["increments"][0] == exact_json::parse(R"({"increment": 1, "fraction": "1/10",
                        "events": [{"pair": 1, "node": 3, "surface": "below", "change": "make"}]})"));
  CHECK(step["increments"][1] == exact_json::parse(R"({"increment": 2, "fraction": "1", "events": []})"));
  CHECK(step["displacement"] ==
        exact_json::parse(R"(["0", "0", "-13/8600", "-117/43000", "-26/5375", "-39/10750"])"));
  CHECK(step["w"] == exact_json::parse(R"(["0", "-13/8600", "-26/5375"])"));
  CHECK(step["pairs"][0] ==
        exact_json::parse(R"({"pair": 1, "node": 3, "surface": "below", "state": "contact",
                                            "gap": "0", "force": "1800/43"})"));
  CHECK(step["reactions"][1] == exact_json::parse(R"({"node": 1, "dof": "theta", "value": "1560/43"})"));
  CHECK(d["kernels"].empty());
  CHECK_FALSE(d.contains("mechanism"));
}

TEST_CASE("if an exact path ends in a mechanism, the output has the rigid-body motion and the work on it") {
  const followed_exactly run(contct::parse_problem(falling, "falling.toml"));
  CHECK_THAT(exact_text(run.result(), 20, {}),
             Contains("share 0, load 0: a rigid-body motion at constant load\n") &&
                 Contains("\nno equilibrium: ") &&
                 Contains("the step's full load does work 1 on it.\n  w 0, -1/2, -1\n"));
  const exact_json d = run.document();
  CHECK(d["status"] == "mechanism");
  CHECK(d["steps"][0]["fraction"] == "0");
  CHECK(d["steps"][0]["increments"][0]["snap"] == true);
  CHECK(d["mechanism"]["motion"] == exact_json::parse(R"(["0", "-1/2", "-1/2", "-1/2", "-1", "-1/2"])"));
  CHECK(d["mechanism"]["work"] == "1");
}
