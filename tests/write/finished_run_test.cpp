// What tables, pictures and the page of a run are made from, and which parts of a large one are shown.
#include "contct/write/finished_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/write/pictures.hpp"
#include "read/bad_inputs.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/one_pair.hpp"
#include "support/scratch_folder.hpp"
#include "support/structures.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// Tell `r` of a call whose answer is `ss`, with this text of unit 26.
void tell_call(run_record& r, std::vector<double> ss, std::string_view text) {
  std::vector<int> isep(ss.size(), separated);
  const call<double> c{{}, {}, {}, ss, 0.5, {}, isep, {}, {1, 1}};
  r.called({c, isep, text});
}

placed_nodes at_places(const std::vector<in_space>& at, const std::vector<int>& directions) {
  placed_nodes places;
  for (const in_space& p : at) places.nodes.push_back({std::to_string(places.nodes.size()), p});
  for (const int direction : directions) places.dofs.push_back({0, direction});
  return places;
}

}  // namespace

TEST_CASE("the first calls are kept with the s of their first pairs, all are counted") {
  run_record r(nullptr);
  for (int i = 0; i < 1205; ++i) tell_call(r, std::vector<double>(10, i), "x");
  CHECK(r.all_calls == 1205);
  REQUIRE(r.calls.size() == run_record::most_calls);
  CHECK(r.calls[7].ss == std::vector<double>(run_record::most_ss, 7.0));
  CHECK(r.calls[7].smin == 0.5);
  CHECK(r.calls[7].followers.empty());
}

TEST_CASE("unit 26 is kept in whole calls only, and nothing behind one that was left out") {
  run_record r(nullptr);
  const std::string most(150'000, 'a');
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, "short");
  CHECK(r.log == most);
  CHECK(r.all_log == 300'005);
}

TEST_CASE("a call has the increment it led to, or none") {
  run_record r(nullptr);
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
  REQUIRE(r.increments.size() == 3);
  CHECK(r.increments[1].snaps);
  CHECK(r.increments[2].fraction == 1.0);
}

TEST_CASE("the first increments are kept, all are counted") {
  run_record r(nullptr);
  const event make{3, change::make};
  for (int i = 1; i <= 1201; ++i) r.incremented({1, i, 0.5, 0.5, {&make, 1}});
  CHECK(r.all_increments == 1201);
  REQUIRE(r.increments.size() == run_record::most_increments);
  CHECK(r.increments.back().number == 1200);
  CHECK(r.increments.back().events == std::vector<event>{make});
}

TEST_CASE("a run without a title has its file's name") {
  const auto title = [](const std::string& text, const std::string& file) {
    const a_run of(text);
    finished_run r = of.finished();
    r.file = file;
    return title_of(r);
  };
  CHECK(title(std::string("title = \"two\\nlines\"\n") + good_problem, "a/b.toml") == "two lines");
  CHECK(title(std::string("title = \" \\n\"\n") + good_problem, "a/b.toml") == "b.toml");
  CHECK(title(good_problem, "-") == "A problem from standard input");
}

TEST_CASE(
    "of a large problem a bounded part is shown, with its largest values, and what is left out is said") {
  std::string text =
      "[beam]\nlength = 50\nelements = 5000\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
  text += "[[bed]]\nmodulus = 100.0\nface = -0.01\n[[step]]\npoint = [ { node = 2222, w = -10.0 } ]\n";
  const a_run r(text);
  const shown_parts shown = choose_parts(r.finished());
  const auto frames = r.kept.frames().size();
  CHECK(shown.nodes.size() * frames <= most_places + 70 * frames);
  CHECK(shown.pairs.size() == most_pairs_of_a_beam);
  CHECK(std::find(shown.nodes.begin(), shown.nodes.end(), 0) != shown.nodes.end());
  CHECK(std::find(shown.nodes.begin(), shown.nodes.end(), shown.watched) != shown.nodes.end());
  REQUIRE(shown.omissions.size() >= 2);
  CHECK_THAT(shown.omissions[0], Contains(" of 5001 nodes"));
  CHECK_THAT(shown.omissions[1], Contains("300 of 5000 pairs"));
  const nlohmann::json data = page_data(r.finished());
  CHECK(data["frames"].back()["counts"][0].get<int>() + data["frames"].back()["counts"][1].get<int>() +
            data["frames"].back()["counts"][2].get<int>() ==
        5000);
  CHECK(data["frames"].back()["largest"]["node"].get<int>() == shown.watched + 1);
}

TEST_CASE("evenly chosen numbers have both ends, and are all where there are few") {
  CHECK(evenly(5, 9) == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(evenly(11, 3) == std::vector<int>{0, 5, 10});
  CHECK(evenly(0, 3).empty());
  CHECK(evenly(9, 1) == std::vector<int>{0});
}

TEST_CASE("a large mesh is drawn as far as a page stays quick: outer edges first, and it is said") {
  // A chain of springs hangs in a block of 30 x 30 x 12 bricks, whose other nodes have no dof.
  std::string inp = "*NODE\n";
  constexpr int n = 31;
  constexpr int high = 13;
  for (int i = 0; i < n * n * high; ++i)
    inp += fmt::format("{},{},{},{}\n", i + 1, i % n, i / n % n, i / n / n);
  inp += "*ELEMENT,TYPE=C3D8\n";
  for (int k = 0; k + 1 < high; ++k) {
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        const int a = (k * n + j) * n + i + 1;
        const int b = a + n * n;
        inp += fmt::format("{0},{0},{1},{2},{3},{4},{5},{6},{7}\n", a, a + 1, a + n + 1, a + n, b, b + 1,
                           b + n + 1, b + n);
      }
    }
  }
  const scratch_folder folder;
  folder.write("block.inp", inp);
  folder.write("block.sti", "1 1 2\n1 2 -1\n2 2 2\n");
  folder.write("block.dof", "6000.3\n6001.3\n");
  const a_run r("[calculix]\njob = \"" + folder.at("block") +
                "\"\n[[step]]\npoint = [ { dof = \"6000.3\", value = -1 } ]\n");
  const auto& places = std::get<assembled>(r.what.geometry.kind).places;
  REQUIRE(places.edges.size() == 30 * 31 * 13 * 2 + 31 * 31 * 12);
  const shown_parts shown = choose_parts(r.finished());
  CHECK(shown.edges.size() == most_edges);
  const auto elements_of = [&](int i) { return places.edges[i].elements; };
  const auto outer =
      std::count_if(places.edges.begin(), places.edges.end(), [](const auto& e) { return e.elements < 4; });
  CHECK(std::count_if(shown.edges.begin(), shown.edges.end(), [&](int i) { return elements_of(i) < 4; }) ==
        outer);
  // What is left of the inner ones is from everywhere: in each fifth of them about as many.
  std::array<int, 5> fifths{};
  for (const int i : shown.edges)
    if (elements_of(i) == 4) ++fifths.at(static_cast<std::size_t>(i) * 5 / places.edges.size());
  CHECK(*std::min_element(fifths.begin(), fifths.end()) * 2 >
        *std::max_element(fifths.begin(), fifths.end()));
  REQUIRE(shown.omissions.size() == 1);
  CHECK_THAT(shown.omissions[0],
             Contains(fmt::format("20000 of {} edges", places.edges.size())) && Contains("of 12493 nodes"));
  CHECK(std::binary_search(shown.nodes.begin(), shown.nodes.end(), 5999));  // it moves most
  CHECK(page_data(r.finished())["frames"][1]["u"].size() == shown.nodes.size());
}

TEST_CASE("of many loads the largest are drawn, by falling magnitude") {
  std::vector<point_load> loads;
  for (int i = 0; i < 100; ++i) loads.push_back({i, 0, i % 2 == 0 ? 1.0 * i : -1.0 * i});
  const std::vector<point_load> drawn = largest_loads(loads);
  REQUIRE(drawn.size() == most_loads);
  CHECK(drawn.front().value == -99.0);
  CHECK(drawn.back().value == 40.0);
  CHECK(largest_loads({{0, 0, 1.0}, {1, 0, -1.0}}).front().node == 0);
}

TEST_CASE("a flat structure that stays flat is looked at straight on, any other from the front and above") {
  const std::vector<in_space> in_xy = {{0, 0, 1}, {1, 0, 1}, {0, 2, 1}};
  const std::vector<in_space> in_xz = {{0, 5, 1}, {1, 5, 0}, {0, 5, 2}};
  const std::vector<in_space> in_yz = {{3, 5, 1}, {3, 4, 0}, {3, 5, 2}};
  const auto view = [](const std::vector<in_space>& at, const std::vector<int>& directions) {
    return std::string(all_views[fitting_view(at_places(at, directions))].name);
  };
  CHECK(view(in_xy, {1, 2, 6}) == "xy");
  CHECK(view(in_xy, {3, 4, 5}) == "oblique");
  CHECK(view(in_xz, {1, 3}) == "xz");
  CHECK(view(in_yz, {2, 3, 4}) == "yz");
  CHECK(view({{0, 0, 0}, {1, 1, 1}}, {1}) == "oblique");
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {3}) == "xz");  // a beam along x
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {2}) == "xy");
  for (const structure_view& v : all_views) {
    INFO(v.name);
    CHECK(std::hypot(v.right[0], v.right[1], v.right[2]) == Approx(1).epsilon(1e-3));
    CHECK(std::hypot(v.up[0], v.up[1], v.up[2]) == Approx(1).epsilon(1e-3));
    CHECK(std::abs(std::inner_product(v.right.begin(), v.right.end(), v.up.begin(), 0.0)) < 1e-3);
  }
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

TEST_CASE("a node has the dof of each of its directions, the first dof of all among them") {
  placed_nodes places;
  places.nodes.resize(2);
  places.dofs = {{0, 1}, {0, 3}, {0, 5}, {1, 2}, {-1, 1}, {1, 4}};
  const std::vector<dofs_of_node> of = dofs_of_nodes(places);
  REQUIRE(of.size() == 2);
  CHECK(of[0].along == std::array<int, 3>{0, -1, 1});
  CHECK(of[0].about == std::array<int, 3>{-1, 2, -1});
  CHECK(of[1].along == std::array<int, 3>{-1, 3, -1});
  CHECK(of[1].about == std::array<int, 3>{5, -1, -1});
}

TEST_CASE("of a long beam the node that deflects most is drawn, once, and fixed supports in order") {
  std::string text =
      "[beam]\nlength = 100.0\nelements = 30000\nEI = 1e6\n[[support]]\nnodes = [1, 20002, 30001]\nfix = "
      "\"w\"\n"
      "[[contact]]\nnode = 2000\nsurface = \"below\"\nface = -1e9\nstiffness = 1.0\n"
      "[[step]]\npoint = [ { node = 11778, w = -1.0 } ]\n";
  const a_run r(text);
  const shown_parts shown = choose_parts(r.finished());
  CHECK(std::ssize(shown.nodes) < 30001);
  CHECK(std::ranges::is_sorted(shown.nodes));
  CHECK(std::ranges::adjacent_find(shown.nodes) == shown.nodes.end());
  for (const int node : {0, 20001, 30000, shown.watched})
    CHECK(std::ranges::binary_search(shown.nodes, node));
}
