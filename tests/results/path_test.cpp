// Tests loads and states along a path, its record, and runs and envelopes of combinations and trains.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "catch.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/load_path.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/step_results.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"

using namespace contct;

namespace {

/// Returns a simple beam of 8 elements over two stops, under these uniform loads in turn.
std::string two_stops(const std::vector<double>& uniform) {
  std::string text =
      "[beam]\nlength = 1\nelements = 8\nEI = 1\n[[support]]\nnodes = [1, 9]\nfix = \"w\"\n"
      "[[contact]]\nnodes = [4, 6]\nsurface = \"below\"\nface = [-0.01, -0.0105]\nstiffness = 1e4\n";
  for (const double q : uniform) text += fmt::format("[[step]]\nuniform = {}\n", q);
  return text;
}

/// Passes a call to `r`, with the answer `ss` and this text of unit 26.
void tell_call(run_recorder& r, std::vector<double> ss, std::string_view text) {
  std::vector<int> isep(ss.size(), separated);
  const call<double> c{{}, {}, {}, ss, 0.5, {}, isep, {}, {1, 1}};
  r.called({c, isep, text});
}

/// A beam on supports at 0 and 1, with a stop of stiffness 6 at a distance of 0.4 below its end at 2. A load
/// P at the end moves it by 2 P / 3.
const std::string overhanging =
    "[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nx = [0, 1]\nfix = \"w\"\n"
    "[[contact]]\nx = 2\nsurface = \"below\"\nface = -0.4\nstiffness = 6\n";
const std::string at_support = "point = [ { x = 1, w = -3 } ]\n";
const std::string at_end = "point = [ { x = 2, w = -3 } ]\n";
const std::string combined =
    overhanging + "[[case]]\nname = 'A'\n" + at_support + "[[case]]\nname = 'B'\n" + at_end +
    "[[combination]]\nname = '1'\nterms = { A = 1 }\n[[combination]]\nname = '2'\nterms = { B = 1 }\n";

/// Returns the moment over the middle support under a unit load at x: -a (L^2 - a^2) / (4 L^2) for spans L
/// and the distance a from the outer support.
double influence_on_middle_moment(double x) {
  if (x < 0.0 || x > 20.0) return 0.0;
  const double a = x <= 10.0 ? x : 20.0 - x;
  return -a * (100.0 - a * a) / 400.0;
}

/// A beam of length 6 on two supports, EI = 1000, under 12 at x = 2, and then under 12 at x = 4.
const std::string load_in_two_places =
    "[beam]\nlength = 6.0\nelements = 3\nEI = 1000.0\n[[support]]\nnodes = [1, 4]\nfix = [\"w\"]\n"
    "[[step]]\npoint = [ { node = 2, w = -12.0 } ]\n[[step]]\npoint = [ { node = 3, w = -12.0 } ]\n";

/// Returns the moment at x of a beam of length 6 on two supports under P = 12 at `a`; deflection_at returns
/// its deflection.
double moment_at(double x, double a) {
  return x < a ? 12 * (6 - a) * x / 6 : 12 * a * (6 - x) / 6;
}
double deflection_at(double x, double a) {
  const auto left_of_load = [](double at, double b) {
    return -12 * b * at * (36 - b * b - at * at) / (6 * 6 * 1000.0);
  };
  return x < a ? left_of_load(x, 6 - a) : left_of_load(6 - x, a);
}

}  // namespace

TEST_CASE("the load at an event is described with keys of the problem file, and fits its column") {
  const std::string point = "point = [ { node = 3, w = -60.0 } ]";
  const std::string mixed = with("point = [", "uniform = -8\npoint = [");
  // Numbers have six digits. If the text is too long, the place is omitted first, then digits, then the kind.
  for (const auto& [text, share, characters, words] :
       {std::tuple(std::string(good_problem), 0.25, 24, "w -15 at node 3"),
        {with(point, "uniform = -8"), 0.5, 24, "uniform -4"},
        {good_problem, 1.0 / 3, 24, "w -20 at node 3"},
        {good_problem, 0.123456, 20, "w -7.40736 at node 3"},
        {good_problem, 0.123456, 19, "w -7.40736"},
        {good_problem, 0.123456, 9, "w -7.41"},
        {good_problem, 0.000123456, 12, "w -0.00741"},
        {mixed, 0.123456, 8, "-9.38266"},
        {good_problem, 0.123456, 3, ""},
        {mixed, 1.0, 24, "force -76"}})
    CHECK(load_path(parsed(text)).words_at(1, share, characters) == words);
  // From -60 to 10 the load is 0 at a share of 6/7, where its computed sum is only rounding.
  const problem passes = parsed(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 10.0 } ]\n");
  CHECK(load_path(passes).words_at(2, 6.0 / 7, 24) == "w 0 at node 3");
  CHECK(load_path(passes).resultant_at(2, 6.0 / 7).force == 0.0);
  CHECK(load_path(passes).words_at(2, 6.0 / 7 + 1e-12, 24) != "w 0 at node 3");
}

TEST_CASE("the description of a load that is not at a node has the coordinates of the load") {
  const auto words = [](load_kind what, double from, double to, model m = beam{{0, 4}, {1.0}}) {
    problem p;
    p.geometry = std::move(m);
    p.steps.resize(1);
    p.steps[0].placed = {{what, from, to, {-5}, {0.25, 0.75}}};
    return load_path(p).words_at(1, 0.5, 60);
  };
  CHECK(words(load_kind::force, 1, 2.5) == "uniform -2.5 from 1 to 2.5");
  CHECK(words(load_kind::curvature, 0, 3) == "curvature -2.5 from 0 to 3");
  CHECK(words(load_kind::point, 3.3, 3.3) == "w -2.5 at x = 3.3");
  CHECK(words(load_kind::moment, 3.3, 3.3) == "theta -2.5 at x = 3.3");
  CHECK(words(load_kind::force, 0.5, 1, plate{{0, 1}, {0, 1}, 1.0, 0.3}) ==
        "uniform -2.5 from (0.5, 0.25) to (1, 0.75)");
}

TEST_CASE("a load of several parts without a force is described by the largest of its first kind") {
  const std::string beam = with("point = [ { node = 3, w = -60.0 } ]", "");
  std::string many = "curvature = [ ";
  for (int i = 0; i < 40; ++i) many += "{ value = 1e-5, from = 0.0, to = 0.5 }, ";
  const std::pair<std::string, std::string> loads[] = {
      {"curvature = [ { value = 1.5e-5 }, { value = -2.5e-5, from = 0, to = 1 } ]", "curvature -2.5e-05"},
      {"curvature = [ { value = 1.5e-5, from = 0, to = 1 } ]\nsettlement = [ { node = 1, w = -1 } ]",
       "curvature 1.5e-05 from 0 to 1"},
      {"point = [ { node = 2, theta = 1 }, { node = 3, theta = -2 } ]", "theta -2"},
      {"point = [ { x = 0.5, theta = 1 }, { node = 3, theta = 1 } ]", "theta 1"},
      {"settlement = [ { node = 1, w = -1 }, { node = 1, theta = 3 } ]", "settle theta 3"},
      {"settlement = [ { node = 1, w = -1 } ]\nmove = [ { node = 3, w = -3 } ]", "settle w -1 at node 1"},
      {"point = [ { node = 2, w = 1 }, { node = 3, w = -1 } ]", "force 0"},
      {"uniform = [ { polynomial = [1, 2] } ]", "force 6"},
      {"uniform = [ { polynomial = [1, 2], from = 0, to = 1 } ]", "force 2"},
      {many + "]", "curvature 1e-05"}};
  for (const auto& [text, words] : loads) {
    const problem p = parsed(beam + text + "\n");
    CAPTURE(text);
    CHECK(load_path(p).words_at(1, 1.0, 60) == words);
  }
}

TEST_CASE("the load on a plate is described as a force, or as wx or wy at a node") {
  problem p = parsed(good_plate);
  CHECK(load_path(p).words_at(1, 1.0, 24) == "force -3");
  p.steps[0].distributed.clear();
  p.steps[0].points = {{5, 2, -0.5}};
  CHECK(load_path(p).words_at(1, 0.5, 24) == "wy -0.25 at node 6");
}

TEST_CASE("within a step, the load changes linearly from that of the previous step, at first from 0") {
  const problem p = parsed(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 20.0 } ]\n");
  const load_path loads(p);
  CHECK(load_at(p, 0, 1.0).points.empty());
  CHECK(load_at(p, 1, 0.5).points[0].value == -30.0);
  CHECK(load_at(p, 2, 0.25).points[0].value == -40.0);
  CHECK(loads.resultant_at(2, 0.25).force == -40.0);
  CHECK(loads.resultant_at(2, 0.25).moments == std::vector<double>{-80.0});
  CHECK_FALSE(loads.has_many_parts(2));
  problem far = p;  // after a large moment about x = 0, a small one keeps its digits
  std::get<beam>(far.geometry.kind).x = {1e9, 1e9 + 1, 1e9 + 2};
  far.steps[1].points = {{1, 0, -2.7}, {2, 0, 2.7}};
  CHECK(load_path(far).resultant_at(2, 1.0).moments == std::vector<double>{2.7});
}

TEST_CASE("a list of loaded elements is written as a range if their numbers are consecutive") {
  CHECK((is_run({4}) && is_run({4, 5, 6})));
  CHECK_FALSE((is_run({4, 6}) || is_run({6, 5, 4})));
}

TEST_CASE("a state within a step equals the final state of a path that ends at the same load") {
  for (const std::string leader : {"fortran", "corrected"}) {
    INFO(leader);
    const std::vector<structure_state> states = pictures_of(a_run(two_stops({-10.0, -0.3}), leader).result);
    REQUIRE(states.size() == 7);  // the start; two makes, full load; two breaks, full load
    for (const structure_state& s : states) {
      if (s.step != 1) continue;
      INFO("increment " << s.number);
      const std::vector<double> end = a_run(two_stops({-10.0 * s.fraction}), leader).end().displacement;
      REQUIRE(s.displacement.size() == end.size());
      for (std::size_t i = 0; i < end.size(); ++i) CHECK(std::abs(s.displacement[i] - end[i]) < 1e-12);
      CHECK(s.displacement[8] < -1e-3);
    }
  }
}

TEST_CASE("a state has the statuses after its events, and a pair at its face is not pressed") {
  const a_run r(two_stops({-10.0}), "cpp");
  const std::vector<structure_state> states = pictures_of(r.result);
  REQUIRE(states.size() == 4);
  CHECK(states[1].isep == std::vector<int>{in_contact, separated});
  for (const auto& [state, pair, look] :
       {std::tuple(1, 0, pair_state::at_face), {1, 1, pair_state::open}, {2, 0, pair_state::closed}})
    CHECK(step_results(r.what, states[state]).pairs[pair].look == look);
}

TEST_CASE("the drawn state at the end of a step equals the state of the path, to the bit") {
  const a_run r(two_stops({-10.0, -0.3, -12.0}));
  std::size_t ends = 0;
  for (const path_moment& m : moments_of(r.result)) {
    if (!m.is_end) continue;
    CHECK(path_states(r.result).at(m).displacement == r.end(ends++).displacement);
  }
  CHECK(ends == 3);
}

TEST_CASE("only some states of a long path are drawn, in order, and the first and the last are among them") {
  for (int steps = 30; steps < 46; ++steps) {
    INFO(steps << " steps");
    std::vector<double> there_and_back;
    for (int i = 0; i < steps; ++i) there_and_back.push_back(i % 2 == 0 ? -10.0 : -0.3);
    const a_run r(two_stops(there_and_back), "cpp");
    CHECK(moments_of(r.result).back().at == 3 * steps);
    const std::vector<structure_state> states = pictures_of(r.result, 12);
    CHECK((states.size() <= 12 && states.size() >= 4));
    CHECK(states.front().step == 0);
    CHECK((states.back().step == steps && states.back().fraction == 1.0));
    CHECK(std::ranges::is_sorted(states, {}, [](const auto& s) { return std::pair(s.step, s.number); }));
  }
}

TEST_CASE("if a structure has many dofs, fewer states of its path are drawn, to save memory") {
  const a_run r(two_stops({-10.0, -0.3, -10.0, -0.3}), "cpp");
  CHECK(pictures_of(r.result).size() == 13);
  const std::vector<structure_state> states = pictures_of(r.result, 100, 90);
  CHECK(states.size() <= 5);
  CHECK(states.back().step == 4);
}

TEST_CASE("a beam that falls on its only pair and balances there has one event, a make") {
  const a_run r(
      "[beam]\nx = [0, 1, 2]\nEI = 1000\n[[contact]]\nnode = 2\nsurface = 'below'\nface = -0.5\n"
      "stiffness = 1e4\n[[step]]\npoint = [ { node = 2, w = -1 } ]\n",
      "corrected");
  std::vector<event> events;
  for (const auto& i : r.result.record.steps.at(0).increments)
    events.insert(events.end(), i.events.begin(), i.events.end());
  CHECK(events == std::vector<event>{{0, change::make}});
}

TEST_CASE("if a structure never moved, two equal states are drawn, for the start and for the end") {
  const a_run r(
      "[beam]\nlength = 1\nelements = 8\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n"
      "[[step]]\nuniform = -10\n",
      "cpp");
  CHECK(r.result.end.status == path_status::mechanism);
  const std::vector<structure_state> states = pictures_of(r.result);
  REQUIRE(states.size() == 2);
  CHECK(states.back().number == 0);
  CHECK(states.back().displacement == states.front().displacement);
}

TEST_CASE("on request, a run keeps its first calls and the first text of unit 26, and counts all of them") {
  run_recorder r(nullptr, {.calls = true});
  for (int i = 0; i < 1205; ++i) tell_call(r, std::vector<double>(10, i), "x");
  CHECK(r.all_calls == 1205);
  REQUIRE(r.calls.size() == run_recorder::most_calls);
  CHECK(r.calls[7].ss == std::vector<double>(run_recorder::most_ss, 7.0));
  CHECK((r.calls[7].smin == 0.5 && r.calls[7].followers.empty()));
  run_recorder texts(nullptr, {.calls = true});
  const std::string most(150'000, 'a');
  for (const std::string& text : {most, most, std::string("short")}) tell_call(texts, {1.0}, text);
  CHECK((texts.log == most && texts.all_log == 300'005));
  run_recorder without;
  tell_call(without, {1.0}, "text");
  CHECK((without.calls.empty() && without.log.empty()));
}

TEST_CASE("a recorded call has the step number of the increment that follows it, or 0 if there is none") {
  run_recorder r(nullptr, {.calls = true});
  tell_call(r, {1.0}, "");
  r.incremented({1, 1, 0.5, 0.5, {}});
  r.incremented({1, 2, 1.0, 0.5, {}, true});  // a snap has no call
  tell_call(r, {1.0}, "");
  tell_call(r, {1.0}, "");
  r.incremented({2, 1, 1.0, 1.0, {}});
  REQUIRE(r.calls.size() == 3);
  CHECK((r.calls[0].number == 1 && r.calls[1].step == 0 && r.calls[2].step == 2));
}

TEST_CASE("a recorded step has its increments with events, and the final state that the path reported") {
  run_recorder r;
  const event make{3, change::make};
  const std::vector<double> u = {0.0, 1.0};
  const std::vector<int> isep = {in_contact};
  r.incremented({1, 1, 0.5, 0.5, {&make, 1}});
  r.incremented({1, 2, 1.0, 1.0, {}, true});
  r.take({{{.step = 1, .fraction = 1.0, .displacement = u, .isep = isep}, path_status::solved},
          {{.step = 2, .fraction = 0.5, .displacement = u, .isep = isep, .from = origin::reference}}});
  REQUIRE(r.steps.size() == 2);
  REQUIRE(r.steps[0].increments.size() == 2);
  CHECK(r.steps[0].increments[0].events == std::vector<event>{make});
  CHECK(r.steps[0].increments[1].snaps);
  CHECK(r.steps[0].displacement == u);
  CHECK(r.steps[0].status == path_status::solved);
  CHECK(r.steps[1].increments.empty());
  CHECK((r.steps[0].number == 2 && r.steps[1].number == 0));
}

TEST_CASE("if a problem has no title, the title of the run is the file name") {
  for (const auto& [begin, file, title] : {std::tuple("title = \"two\\nlines\"\n", "a/b.toml", "two lines"),
                                           {"title = \" \\n\"\n", "a/b.toml", "b.toml"},
                                           {"", "-", "A problem from standard input"}})
    CHECK(title_of(parsed(std::string(begin) + good_problem), file) == title);
}

TEST_CASE("An envelope has the values of combinations, but not of states between two combinations") {
  const a_run steps(overhanging + "[[step]]\n" + at_support + "[[step]]\n" + at_end);
  CHECK(listed(envelope_of(steps.result), "reaction")[1].most.value ==
        Approx(3.6));  // when the end reaches the stop
  const a_run run(combined);
  const envelope all = envelope_of(run.result);
  CHECK((all.states == 2 && listed(all, "reaction")[1].most.step == 1));
  CHECK(listed(all, "reaction")[1].most.value == Approx(3.0));
  CHECK(listed(all, "reaction")[1].least.value == Approx(2.16));  // 2 (3 - 1.92)
  const auto& force = listed(all, "force")[0].most;
  CHECK(force.value == Approx(1.92));  // (2 - 0.4) / (2 / 3 + 1 / 6)
  CHECK((force.step == 2 && force.increment == 2));
}

TEST_CASE("Moving axles make the moment over the middle support that follows from the influence line") {
  const a_run run(
      "[beam]\nlength = 20\nelements = 20\nEI = 2e4\n[[support]]\nx = [0, 10, 20]\nfix = 'w'\n"
      "[[train]]\nname = \"T\"\naxles = [ { at = 0, w = -35 }, { at = 4, w = -145 } ]\n"
      "from = -3\nto = 20\nby = 1\nfactor = 1.5\n");
  REQUIRE(run.result.record.steps.size() == 24);
  for (std::size_t k = 0; k < 24; ++k) {
    const double x = static_cast<double>(k) - 3;
    const double moment =
        1.5 * (35 * influence_on_middle_moment(x) + 145 * influence_on_middle_moment(x + 4));
    CHECK(run.results(k).elements.at(9, 1)[1] == Approx(moment).epsilon(1e-9).margin(1e-9));
  }
  CHECK(run.result.all_certified());
}

TEST_CASE("States within a combination are computed from the unloaded structure") {
  const a_run run(combined);
  path_states states(run.result);
  const path_moment first = moments_of(run.result).at(1);  // the stop makes contact
  CHECK(first.increment->fraction == Approx(0.2));
  CHECK(states.at(first).displacement[4] == Approx(-0.4));
  CHECK(load_path(run.what).resultant_at(2, 0.2).force == Approx(-0.6));
}

TEST_CASE("The envelope of a load at two places has the extremes of the two states at each point") {
  const envelope all = envelope_of(a_run(load_in_two_places, "corrected").result, true);
  REQUIRE(all.curves.size() == 3);
  CHECK(all.x.size() > 300);
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    const double x = all.x[i];
    const auto& [w, moment, shear] = std::tie(all.curves[0].at[i], all.curves[1].at[i], all.curves[2].at[i]);
    CAPTURE(x);
    CHECK(moment.most.value == Approx(std::max(moment_at(x, 2), moment_at(x, 4))).margin(1e-9));
    CHECK(moment.least.value == Approx(std::min(moment_at(x, 2), moment_at(x, 4))).margin(1e-9));
    CHECK(w.least.value == Approx(std::min(deflection_at(x, 2), deflection_at(x, 4))).margin(1e-12));
    if (x > 0.1 && x < 2.9) CHECK((moment.most.step == 1 && moment.least.step == 2));
    if (x > 3.1 && x < 5.9) CHECK(moment.most.step == 2);
  }
}

TEST_CASE("Envelope curves have the pressure of beds, linear between nodes") {
  const a_run r(
      parsed("[beam]\nlength = 4\nelements = 3\nEI = 9\n[[bed]]\nmodulus = 100\nface = 0\n[[case]]\n"
             "name = 'G'\nuniform = [ { polynomial = [-2, -1] } ]\n[[combination]]\nname = 'A'\n"
             "terms = { G = 1 }\n[[combination]]\nname = 'B'\nterms = { G = 2 }\n"),
      "corrected");
  const envelope all = envelope_of(r.result, true);
  REQUIRE(all.curves.size() == 4);
  const auto& at = all.curves[3].at;
  const std::vector<double> in_a = bed_pressure(r.results());
  const std::size_t parts = at.size() / 3 - 1;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::size_t e = i / (parts + 1);
    const double t = static_cast<double>(i % (parts + 1)) / static_cast<double>(parts);
    CHECK((at[i].least.step == 1 && at[i].most.step == 2));
    CHECK(at[i].least.value == Approx(in_a[e] + t * (in_a[e + 1] - in_a[e])));
    CHECK(at[i].most.value == Approx(2 * at[i].least.value));
  }
}

TEST_CASE("Envelope curves have the shear on both sides of a jump, and each value has its step") {
  const envelope all = envelope_of(a_run(load_in_two_places, "corrected").result, true);
  const auto at_node = std::find(all.x.begin(), all.x.end(), 2.0);
  const std::size_t left = at_node - all.x.begin();
  REQUIRE(all.x.at(left + 1) == 2.0);
  const auto& shear = all.curves.at(2).at;
  CHECK((shear[left].most.step == 1 && shear[left + 1].most.step == 2));
  CHECK(shear[left].most.value == Approx(8.0));   // 12 * 4 / 6, of step 1
  CHECK(shear[left].least.value == Approx(4.0));  // 12 * 2 / 6, of step 2
  CHECK(shear[left + 1].most.value == Approx(4.0));
  CHECK(shear[left + 1].least.value == Approx(-4.0));  // 8 - 12, of step 1
  CHECK(envelope_of(a_run(std::string(good_plate), "corrected").result, true).x.empty());  // a plate has none
}
