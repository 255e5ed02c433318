// Tests observers of a path: the explanation of its calls, its early toggles, and its trace.
#include "contct/path/path_observers.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/compare/compare.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

/// The explained increments of PB1, with `second` as the second kernel.
struct explained_pb1 {
  struct told {
    int step, number;
    double fraction_before, smin, other_smin;
    int winner;
    bool apart;
  };
  std::vector<told> increments;
  explained_path path;

  explicit explained_pb1(const std::vector<std::string>& second, increments_wanted wanted = {})
      : path(facts_of_kernel("fortran"), second, wanted, [this](const explained_increment& i) {
          increments.push_back({i.what.step, i.what.number, i.fraction_before, i.call.smin,
                                i.other == nullptr ? std::nan("") : i.other->smin, i.call.winner,
                                i.apart.has_value()});
        }) {
    cantilever_over_a_stop().run("fortran", {&path});
  }
};

/// Passes a call with one pair to the observer, with these inputs, SMIN and final status.
void call_with(observer& o, double d, double d_star, double c, double smin, int isep_after) {
  const std::vector<double> dd = {d}, dtest = {d_star}, cc = {c};
  std::vector<double> ss = {smin};
  const std::vector<int> id = {1}, before = {separated}, isurf = {face_below};
  std::vector<int> isep = {isep_after};
  const call<double> answered{dd, dtest, cc, ss, smin, id, isep, isurf, {}};
  o.called({answered, before});
}

}  // namespace

TEST_CASE(
    "every increment of a cantilever over a stop (PB1) is explained and compared with a second kernel") {
  const explained_pb1 all({"cpp"});
  REQUIRE(all.increments.size() == 6);
  CHECK(all.path.calls() == 6);
  CHECK(all.path.explained() == 6);
  CHECK(all.path.steps() == 4);
  CHECK(all.path.most_increments() == 2);
  CHECK(all.path.compared().values == 6L * 4);
  CHECK(all.path.compared().mismatches == 0);
  CHECK_FALSE(all.path.first());
  for (const auto& i : all.increments) {
    INFO("step " << i.step << ", increment " << i.number);
    CHECK(i.other_smin == i.smin);
    CHECK_FALSE(i.apart);
    CHECK((i.winner == 0) == (i.smin < 1.0));
    CHECK((i.fraction_before > 0.0) == (i.number == 2));
  }
}

TEST_CASE("one increment of one kernel can be explained without a second kernel") {
  const explained_pb1 one({}, {2, 2});
  REQUIRE(one.increments.size() == 1);
  CHECK(one.increments[0].step == 2);
  CHECK(one.increments[0].number == 2);
  CHECK(one.increments[0].fraction_before > 0.0);
  CHECK(std::isnan(one.increments[0].other_smin));
  CHECK(one.path.compared().values == 0);
  CHECK(one.path.calls() == 6);
  CHECK_THROWS_AS(explained_pb1({"corrected"}), std::invalid_argument);
}

TEST_CASE(
    "a toggle before the face counts as early, and the distance is relative to the largest deflection") {
  early_toggles early;
  const event makes{0, change::make};
  const std::vector<event> events = {makes};
  call_with(early, 0.0, -2.0, -1.0, 0.5, in_contact);  // the pair reaches its face at -1
  early.incremented({1, 1, 0.5, 0.5, events});
  CHECK(early.all().empty());
  call_with(early, 0.0, -2.0, -1.25, 0.5, in_contact);  // the pair is 0.25 before its face
  early.incremented({1, 2, 0.5, 1.0, {}});              // the driver has undone the toggle
  CHECK(early.all().empty());
  call_with(early, 0.0, -2.0, -1.25, 0.5, in_contact);
  early.incremented({2, 1, 0.5, 0.5, events});
  REQUIRE(early.all().size() == 1);
  CHECK(early.all()[0].step == 2);
  CHECK(early.all()[0].number == 1);
  CHECK(early.all()[0].what == makes);
  CHECK(early.all()[0].distance == 0.25);
  CHECK(early.all()[0].share == 0.25);
}

TEST_CASE("a kernel that replays the recorded trace of its own path gives the recorded answers") {
  std::string text;
  const kernel_facts leader = facts_of_kernel("fortran");
  trace_recorder recorder(header_for(leader, "a checksum"), [&text](std::string_view part) { text += part; });
  CHECK(text.rfind(trace_format, 0) == 0);
  cantilever_over_a_stop().run("fortran", {&recorder});
  trace_reader calls(text, "recorded");
  const trace_header h = calls.read_header();
  CHECK(h.kernel == "fortran");
  CHECK(h.listing == "a checksum");
  const replay_report r = replay(h, calls, *make_kernel("cpp"));
  CHECK(r.calls == 6);
  CHECK(r.compared.values == 6L * 4);
  CHECK(r.compared.mismatches == 0);
}
