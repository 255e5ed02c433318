// What outputs are made from: what is recorded of a path, and what is read off its states.

#include "contct/write/run_result.hpp"

#include <algorithm>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_inputs.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/one_pair.hpp"
#include "support/structures.hpp"

using namespace contct::app;

namespace {

/// Tell `r` of a call whose answer is `ss`, with this text of unit 26.
void tell_call(run_recorder& r, std::vector<double> ss, std::string_view text) {
  std::vector<int> isep(ss.size(), separated);
  const call<double> c{{}, {}, {}, ss, 0.5, {}, isep, {}, {1, 1}};
  r.called({c, isep, text});
}

}  // namespace

TEST_CASE("the first calls are kept with the s of their first pairs, all are counted") {
  run_recorder r(nullptr, true);
  for (int i = 0; i < 1205; ++i) tell_call(r, std::vector<double>(10, i), "x");
  CHECK(r.all_calls == 1205);
  REQUIRE(r.calls.size() == run_recorder::most_calls);
  CHECK(r.calls[7].ss == std::vector<double>(run_recorder::most_ss, 7.0));
  CHECK(r.calls[7].smin == 0.5);
  CHECK(r.calls[7].followers.empty());
}

TEST_CASE("unit 26 is kept in whole calls only, and nothing behind one that was left out") {
  run_recorder r(nullptr, true);
  const std::string most(150'000, 'a');
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, "short");
  CHECK(r.log == most);
  CHECK(r.all_log == 300'005);
}

TEST_CASE("a call has the increment it led to, or none") {
  run_recorder r(nullptr, true);
  tell_call(r, {1.0}, "");
  r.incremented({1, 1, 0.5, 0.5, {}});
  r.incremented({1, 2, 1.0, 0.5, {}, true});  // a snap, without a call
  tell_call(r, {1.0}, "");
  tell_call(r, {1.0}, "");
  r.incremented({2, 1, 1.0, 1.0, {}});
  REQUIRE(r.calls.size() == 3);
  CHECK(r.calls[0].number == 1);
  CHECK(r.calls[1].step == 0);
  CHECK(r.calls[2].step == 2);
}

TEST_CASE("calls are not kept where nobody asks for them") {
  run_recorder r;
  tell_call(r, {1.0}, "text");
  CHECK(r.calls.empty());
  CHECK(r.log.empty());
}

TEST_CASE("a step has its increments with their events, and its end as the path told it") {
  run_recorder r;
  const event make{3, change::make};
  const std::vector<double> u = {0.0, 1.0};
  const std::vector<int> isep = {in_contact};
  r.incremented({1, 1, 0.5, 0.5, {&make, 1}});
  r.incremented({1, 2, 1.0, 1.0, {}, true});
  r.step_ended({1, 1.0, u, isep, 0.25});
  r.step_ended({2, 0.5, u, isep, 0.25, true});
  REQUIRE(r.steps.size() == 2);
  REQUIRE(r.steps[0].increments.size() == 2);
  CHECK(r.steps[0].increments[0].events == std::vector<event>{make});
  CHECK(r.steps[0].increments[1].snaps);
  CHECK(r.steps[0].end.displacement == u);
  CHECK(r.steps[0].rcond == 0.25);
  CHECK(r.steps[1].increments.empty());
  CHECK(r.steps[1].end.from_fallback);
}

TEST_CASE("a run without a title has its file's name") {
  const auto title = [](const std::string& text, const std::string& file) {
    return title_of(parse_problem(text, "pb.toml"), file);
  };
  CHECK(title(std::string("title = \"two\\nlines\"\n") + good_problem, "a/b.toml") == "two lines");
  CHECK(title(std::string("title = \" \\n\"\n") + good_problem, "a/b.toml") == "b.toml");
  CHECK(title(good_problem, "-") == "A problem from standard input");
}

TEST_CASE("what deflects is what is known to be a length: a matrix's pairs, and what is along an axis") {
  const problem placed = parse_problem(portal_frame(), "p.toml", reach::anywhere);
  const std::vector<int> dofs = deflecting_nodes(placed);
  CHECK(dofs.size() == 22);
  CHECK(std::none_of(dofs.begin(), dofs.end(), [](int dof) { return dof % 3 == 2; }));
  problem bare = parse_problem(frame_without_coordinates(), "p.toml", reach::anywhere);
  CHECK(deflecting_nodes(bare) == std::vector<int>{16, 21});
  bare.pairs.clear();
  CHECK(deflecting_nodes(bare).size() == 33);
}

TEST_CASE("a pair is read at its deflection: gap or force, never both") {
  const problem p = parse_problem(good_problem, "pb.toml");  // face -0.004, stiffness 5e4
  const pair_reading open = reading_of(p.pairs[0], -0.001, false);
  CHECK(open.gap == Approx(0.003));
  CHECK(open.force == 0.0);
  CHECK(open.look == pair_state::open);
  const pair_reading closed = reading_of(p.pairs[0], -0.005, true);
  CHECK(closed.gap == 0.0);
  CHECK(closed.force == Approx(50.0));
  CHECK(closed.look == pair_state::closed);
  CHECK(reading_of(p.pairs[0], -0.004, false).look == pair_state::at_face);
}

TEST_CASE("the largest value is so by magnitude, and the first of equals") {
  extreme most;
  most.take(3, -2.0);
  most.take(4, 1.0);
  most.take(5, 2.0);
  CHECK(most.at == 3);
  CHECK(most.value == -2.0);
}

TEST_CASE("a plate's nodes go along x first, and w is the first of a node's dofs") {
  const problem p = parse_problem(good_plate, "pb.toml");
  CHECK(place_of_node(p.geometry, 4).x == 0.5);
  CHECK(place_of_node(p.geometry, 4).y == 1.0);
  CHECK(place_name(p.geometry, 4) == "5");
  std::vector<double> u(18);
  u[12] = 7.0;
  CHECK(deflection_of(p, u, 4) == 7.0);
}

TEST_CASE("an event's load is told in the words of the problem file") {
  const problem p = parse_problem(good_problem, "pb.toml");
  CHECK(load_path(p).words_at(1, 0.25, 24) == "w -15 at node 3");
  const problem uniform =
      parse_problem(with("point = [ { node = 3, w = -60.0 } ]", "uniform = -8"), "pb.toml");
  CHECK(load_path(uniform).words_at(1, 0.5, 24) == "uniform -4");
  const problem mixed = parse_problem(with("point = [", "uniform = -8\npoint = ["), "pb.toml");
  // The number has six digits in every row; where there is no room, the place goes first, then the kind.
  CHECK(load_path(p).words_at(1, 1.0 / 3, 24) == "w -20 at node 3");
  CHECK(load_path(p).words_at(1, 0.123456, 20) == "w -7.40736 at node 3");
  CHECK(load_path(p).words_at(1, 0.123456, 19) == "w -7.40736");
  CHECK(load_path(p).words_at(1, 0.123456, 8) == "-7.40736");
  CHECK(load_path(p).words_at(1, 0.123456, 3).empty());
  CHECK(load_path(mixed).words_at(1, 1.0, 24) == "force -76");
  // From -60 to 10 the load passes 0 at 6/7, where the sum is nothing but rounding.
  problem passes = p;
  passes.steps.push_back(p.steps[0]);
  passes.steps[1].points[0].value = 10.0;
  CHECK(load_path(passes).words_at(2, 6.0 / 7, 24) == "w 0 at node 3");
  CHECK(load_path(passes).resultant_at(2, 6.0 / 7).force == 0.0);
  CHECK(load_path(passes).words_at(2, 6.0 / 7 + 1e-12, 24) != "w 0 at node 3");
}

TEST_CASE("a plate's loads are told in its own words") {
  const problem p = parse_problem(good_plate, "pb.toml");
  CHECK(load_path(p).words_at(1, 1.0, 24) == "force -3");
  const std::string mistake = "uniform = [ { value = -1.0 }, { value = -2.0, elements = \"2..2\" } ]\n";
  const problem slope = parse_problem(
      plate_with(mistake + "point = [ { node = 3, w = -1.0, wx = 0.25 }, { node = 6, wy = -0.5 } ]",
                 "point = [ { node = 6, wy = -0.5 } ]"),
      "pb.toml");
  CHECK(load_path(slope).words_at(1, 0.5, 24) == "wy -0.25 at node 6");
}

TEST_CASE("between steps the load goes straight from one total to the next, from nothing at first") {
  const problem p =
      parse_problem(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 20.0 } ]\n", "pb.toml");
  const load_path loads(p);
  CHECK(loads.at(0, 1.0).points.empty());
  CHECK(loads.at(1, 0.5).points[0].value == -30.0);
  CHECK(loads.at(2, 0.25).points[0].value == -40.0);
  CHECK(loads.resultant_at(2, 0.25).force == -40.0);
  CHECK(loads.resultant_at(2, 0.25).moments == std::vector<double>{-80.0});
  CHECK_FALSE(loads.has_many_parts(2));
}

TEST_CASE("elements are a run when they follow one another upwards") {
  CHECK(is_run({4}));
  CHECK(is_run({4, 5, 6}));
  CHECK_FALSE(is_run({4, 6}));
  CHECK_FALSE(is_run({6, 5, 4}));
}

TEST_CASE("the share of a load that rounding has left of it is told as none") {
  const problem p = parse_problem(good_problem, "pb.toml");
  const load_path loads(p);
  CHECK(loads.words_at(1, 1e-18, 80) == loads.words_at(1, 0.0, 80));
  CHECK(loads.words_at(1, 1e-3, 80) != loads.words_at(1, 0.0, 80));
}
