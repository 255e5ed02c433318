// Tests the words for statuses, events and certificates of the formats in reference/.
#include "contct/write/words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "read/bad_inputs.hpp"
#include "support/a_run.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE(
    "a path that does not reach its load has one of three statuses, and the reason is a separate value") {
  CHECK(status_name(path_status::solved) == "solved");
  CHECK(status_name(path_status::mechanism) == "mechanism");
  CHECK(status_name(path_status::path_ended) == "path-ended");
  for (const auto other : {path_status::cycle, path_status::iteration_limit, path_status::not_factored})
    CHECK(status_name(other) == "iteration-limit");
  CHECK(end_reason(path_status::solved) == "all load applied");
  CHECK(end_reason(path_status::cycle) == "cycle");
  CHECK(end_reason(path_status::not_factored) == "not factored");
  CHECK(end_reason(path_status::path_ended) == "path ended");
}

TEST_CASE(
    "the summary of a certified run gives the number of certified steps, and there is no message of an "
    "error") {
  const a_run one(good_problem);
  CHECK(certificate_summary(one.result, true)[0] == "the final state is certified");
  CHECK(certificate_complaints(one.result).empty());
  const a_run two(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 20.0 } ]\n");
  CHECK(certificate_summary(two.result, true)[0] == "both final states are certified");
}

TEST_CASE(
    "a path that ended before full load is not certified, even if all steps that it reached are certified") {
  const a_run one(good_problem);
  const std::vector<std::string> items = certificate_summary(one.result, false);
  REQUIRE(items.size() == 2);
  CHECK_THAT(items[0], Contains("the run is NOT certified"));
  CHECK(items[1] == "step 1 is certified");
}

TEST_CASE("if a pair in contact pulls under the 1989 rule, the message names the pair and gives the force") {
  const a_run r(  // the exact forces are 2.75e-4 and 0
      "[beam]\nlength = 128\nelements = 128\nEI = 1e4\n"
      "[[support]]\nnodes = [1, 129]\nfix = \"w\"\n"
      "[[contact]]\nnodes = [65, 33]\nsurface = \"above\"\nface = [1e-4, 2e-4]\nstiffness = 1e3\n"
      "[[step]]\nuniform = -0.37252902984619140625\n[[step]]\nuniform = 3.7252902984619140625e-6\n");
  const std::vector<std::string> complaints = certificate_complaints(r.result);
  REQUIRE(complaints.size() == 1);
  CHECK_THAT(complaints[0], Contains("step 2 is not certified: ") &&
                                Contains("; pair 2 (node 33, above) pulls with 0.129; in increment 2.1 "));
}

TEST_CASE("if forces are locked in, the summary names the step, and the message describes the early toggle") {
  const a_run r(read_input(CONTCT_REFERENCE "/problems/divergences/near-tie.toml"));
  const std::vector<std::string> complaints = certificate_complaints(r.result);
  REQUIRE_FALSE(complaints.empty());
  const std::string step = complaints[0].substr(0, complaints[0].find(" is not certified: "));
  CHECK_THAT(certificate_summary(r.result, true)[0], Contains(step + " is NOT certified: "));
  const early_toggle& first = r.result.early.all().front();
  CHECK_THAT(complaints[0],
             Contains("; in increment ") && Contains(" contact ") && Contains(" from its face"));
  CHECK(first.distance > 0.0);
  CHECK_THAT(complaints_of(r.result).back(), Contains("contct run ") && Contains(" --kernels corrected"));
}

TEST_CASE("a message about an error gives the size in units first, and then in per cent") {
  problem p = parse_problem(read_input(CONTCT_REFERENCE "/problems/divergences/near-tie.toml"), "pb.toml");
  p.units = {"m", "kN"};
  const a_run r(std::move(p));
  const std::vector<std::string> complaints = certificate_complaints(r.result);
  REQUIRE(complaints.size() == 2);  // 0.5 L^3 / 3 EI = 1.3333e-4 of 4.44e-3, see near-tie.toml
  CHECK_THAT(
      complaints[1],
      Contains("the deflections are off by 0.00013 m, 3 % of the largest deflection; allowed: 0.0001 %"));
  CHECK_THAT(complaints[1],
             Contains("made contact 1e-05 m from its face (0.25 % of the largest deflection)"));
}

TEST_CASE("the number of proved digits of a run is that of the step with the largest error bound") {
  const a_run two(
      "[beam]\nlength = 100.0\nelements = 400\nEI = 1.0\n[[support]]\nnodes = [1, 401]\nfix = \"w\"\n"
      "[[step]]\nuniform = -1.0\n[[step]]\npoint = [ { node = 200, w = 1.0 } ]\n");
  double worst = 0.0;
  for (const auto& c : two.result.judged.steps()) worst = std::max(worst, c.value().worst_share);
  REQUIRE(worst > 1e-10);  // otherwise the summary is "10 digits or more"
  const int digits = static_cast<int>(-std::log10(worst));
  const std::string said = digits >= 10 ? "10 digits or more" : std::to_string(digits) + " digits";
  CHECK(certificate_summary(two.result, true)[1] == "proved: " + said + " of every number");
}

TEST_CASE(
    "a message does not name a toggle as the cause of an error if the toggle is early only by rounding") {
  a_run r(read_input(CONTCT_REFERENCE "/problems/divergences/near-tie.toml"));
  REQUIRE_FALSE(r.result.judged.all_certified());
  CHECK_THAT(certificate_complaints(r.result).at(0), Contains("; in increment 1."));
  // In the first step, with almost no deflection, a pair was toggled 1e-18 too early.
  early_toggles tiny;
  const std::vector<double> dd = {0.0}, dtest = {1e-18}, cc = {2e-18};
  std::vector<double> ss = {1.0};
  const std::vector<int> id = {1}, before = {separated}, isurf = {face_above};
  std::vector<int> isep = {in_contact};
  const call<double> answered{dd, dtest, cc, ss, 1.0, id, isep, isurf, {}};
  tiny.called({answered, before, ""});
  const std::vector<event> events = {{0, change::make}};
  tiny.incremented({1, 1, 1.0, 0.5, events});
  REQUIRE(tiny.all().size() == 1);
  r.result.early = tiny;
  CHECK_THAT(certificate_complaints(r.result).at(0), !Contains("; in increment"));
}

namespace {

/// Returns a plate on supports along its edges, with these tables for its middle, node 13.
std::string square_with(const std::string& tables) {
  return "[plate]\nsize = [1, 1]\nelements = [4, 4]\nE = 10.92\nnu = 0.3\nthickness = 1\n[[support]]\n"
         "nodes = [1, 2, 3, 4, 5, 6, 10, 11, 15, 16, 20, 21, 22, 23, 24, 25]\nfix = \"w\"\n" +
         tables;
}

std::string warned_of(const std::string& tables) {
  const a_run r(square_with(tables), "corrected");
  return concentration_warning(r.what, r.result.record.steps);
}

}  // namespace

TEST_CASE(
    "contct run warns if a plate's largest stress is under a point load, but not if it is under a pressure") {
  CHECK_THAT(warned_of("[[step]]\npoint = [ { node = 13, w = -1 } ]\n"),
             StartsWith("step 1: largest von Mises at node 13, (0.5, 0.5), under a point load: "));
  CHECK(warned_of("[[step]]\nuniform = [ { value = -16, from = [0.375, 0.375], to = [0.625, 0.625] } ]\n")
            .empty());
  CHECK(warned_of("[[step]]\nuniform = -1\npoint = [ { node = 13, w = 0 } ]\n").empty());
}

TEST_CASE(
    "contct run does not warn of a force at a free corner of a plate, where the twisting moment is half the "
    "force") {
  const a_run r(
      "[plate]\nsize = [1, 1]\nelements = [4, 4]\nE = 10.92\nnu = 0.3\nthickness = 1\n[[support]]\n"
      "nodes = [5, 21, 25]\nfix = \"w\"\n[[step]]\npoint = [ { node = 1, w = -1 } ]\n",
      "corrected");
  CHECK(std::abs(results_of(r.what, r.what.steps[0], r.result.record.steps[0].end).elements.values[8]) ==
        Approx(0.5));
  CHECK(concentration_warning(r.what, r.result.record.steps).empty());
}

TEST_CASE("contct run warns if the largest stress of a plate is at a pair in contact") {
  const auto stop = [](const char* face) {
    return fmt::format(
        "[[contact]]\nnode = 13\nsurface = \"below\"\nface = {}\nstiffness = 1e4\n[[step]]\nuniform = -1\n",
        face);
  };
  CHECK_THAT(warned_of(stop("0")), Contains(" at node 13, (0.5, 0.5), under the force of pair 1: "));
  CHECK(warned_of(stop("-1")).empty());
}
