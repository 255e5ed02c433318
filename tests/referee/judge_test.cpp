// The judge notices each thing that can be wrong: a right run is judged by an exact answer that was made
// wrong.
#include "referee/judge.hpp"

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "referee/hard_problems.hpp"

using namespace contct::referee;
using contct::exact::rational;
using contct::path::path_status;

namespace {

/// It comes down on its pair in the first step, and is off it again in the second.
contct::structure::problem beam_over_a_stop() {
  return contct::read::parse_problem(R"(
[beam]
x = [0, 1, 2]
EI = 1e4
[[support]]
node = 1
fix = ["w", "theta"]
[[contact]]
node = 3
surface = "below"
face = -0.004
stiffness = 5e4
[[step]]
point = [ { node = 3, w = -50 } ]
[[step]]
point = [ { node = 3, w = -1 } ]
)",
                                     "beam.toml");
}

int count(const judgement& j, fault what) {
  int n = 0;
  for (const finding& f : j.findings) n += f.what == what ? 1 : 0;
  return n;
}

/// The faults found when `spoil` was done to the exact answer.
template <class Spoil>
judgement judged_after(Spoil spoil, way how = way::default_engine) {
  const contct::structure::problem p = beam_over_a_stop();
  exact_answer exactly(p);
  spoil(exactly);
  return judge(p, exactly, how);
}

const rational wrong_by(1001, 1000);

}  // namespace

TEST_CASE("a run that is right has nothing wrong with it, in any way, and all of its numbers are compared") {
  for (const way how : {way::default_engine, way::refactor, way::final_only, way::listing}) {
    const judgement j = judged_after([](exact_answer&) {}, how);
    INFO(name_of(how));
    for (const finding& f : j.findings) UNSCOPED_INFO(name_of(f.what) << ": " << f.words);
    CHECK(j.findings.empty());
    CHECK(j.steps == 2);
    CHECK(j.certified == 2);
    CHECK(j.values == 18);  // six displacements, a force and two reactions, twice
    CHECK_FALSE(j.mechanism);
  }
}

TEST_CASE(
    "a deflection, a slope, a pair's force and a reaction that are wrong are each noticed as what they are") {
  const auto expect = [](const judgement& j, fault outside, fault beyond) {
    CHECK(count(j, outside) == 1);
    CHECK(count(j, beyond) == 1);
    CHECK(count(j, fault::digits) == 1);
    CHECK(j.findings.size() == 3);
  };
  expect(judged_after([](exact_answer& e) { e.path.steps[0].displacement[4] *= wrong_by; }),
         fault::outside_deflection, fault::beyond_deflection);
  expect(judged_after([](exact_answer& e) { e.path.steps[0].displacement[5] *= wrong_by; }),
         fault::outside_slope, fault::beyond_slope);
  expect(judged_after([](exact_answer& e) { e.path.steps[0].force[0] *= wrong_by; }), fault::outside_force,
         fault::beyond_force);
  expect(judged_after([](exact_answer& e) { e.path.steps[0].reactions[1] *= wrong_by; }),
         fault::outside_reaction, fault::beyond_reaction);
}

TEST_CASE(
    "a number's error is measured by its own state, and by the largest of the path as the certificate does") {
  // 1e-8 of the second step's deflections: more than the certificate's tolerance, less than a millionth.
  const judgement j = judged_after(
      [](exact_answer& e) { e.path.steps[1].displacement[4] *= rational(100'000'001, 100'000'000); });
  CHECK(count(j, fault::outside_deflection) == 1);
  CHECK(count(j, fault::beyond_deflection) == 0);
  CHECK(count(j, fault::digits) == 1);
}

TEST_CASE("where equilibria differ by a rigid motion, displacements are not compared") {
  const judgement j = judged_after([](exact_answer& e) {
    e.unique.assign(2, 0);
    e.path.steps[0].displacement[4] *= wrong_by;
  });
  CHECK(j.findings.empty());
  CHECK(j.values == 6);  // a force and two reactions, twice
}

TEST_CASE("ends that are wrong are told apart") {
  const auto ended = [](path_status status) { return [status](exact_answer& e) { e.path.status = status; }; };
  CHECK(count(judged_after(ended(path_status::mechanism)), fault::false_solution) == 1);
  CHECK(count(judged_after(ended(path_status::mechanism), way::final_only), fault::false_solution) == 1);

  contct::structure::problem p = beam_over_a_stop();
  const exact_answer held(p);
  p.supports.clear();  // now it turns about its pair
  p.steps[0].points[0].node = 1;
  const judgement j = judge(p, held, way::refactor);
  CHECK(count(j, fault::false_mechanism) == 1);
  const exact_answer free(p);
  CHECK(free.path.status == path_status::mechanism);
  CHECK(judge(p, free, way::refactor).findings.empty());
  CHECK(judge(p, free, way::refactor).mechanism);
}

TEST_CASE("a matrix that is refused is noticed") {
  contct::structure::problem p;
  contct::structure::assembled a;
  a.name = "K.mtx";
  a.stiffness = {2, {{0, 0, 1.0}, {1, 0, 2.0}, {1, 1, 1.0}}};
  p.geometry.kind = a;
  p.supports.push_back({0, 0, true, 0.0});
  p.steps.push_back({{{1, 0, 1.0}}, {}});
  const exact_answer exactly(p);
  CHECK(judge(p, exactly, way::default_engine).findings.empty());
  p.supports.clear();
  const judgement j = judge(p, exactly, way::default_engine);
  CHECK(count(j, fault::refused) == 1);
}

TEST_CASE("bounds that are proved but too large to certify are noticed") {
  // Four masses in a row, held by 1e-14 alone, which could be the rounding of what is written as 1.
  const contct::structure::problem p = make_hard_problem(2026, 69 / 2 / hard_kinds, hard_kind::soft_matrices);
  const exact_answer exactly(p);
  CHECK(count(judge(p, exactly, way::default_engine), fault::loose) == 1);
  CHECK(count(judge(p, exactly, way::listing), fault::loose) == 0);
  contct::structure::problem held = p;
  std::get<contct::structure::assembled>(held.geometry.kind).free_motions = 0;
  CHECK(judge(held, exactly, way::default_engine).findings.empty());
}

TEST_CASE("an event that is not exact is noticed") {
  const judgement j = judged_after([](exact_answer& e) {
    e.path.steps[0].increments.front().events.front().what = contct::kernels::change::break_;
  });
  CHECK(count(j, fault::other_events) == 1);
}

TEST_CASE("a path that was lost is noticed") {
  contct::structure::problem p = contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/lost-path.toml");
  const exact_answer exactly(p);
  CHECK(count(judge(p, exactly, way::default_engine), fault::fallback) == 0);
  CHECK(count(judge(p, exactly, way::refactor), fault::fallback) == 0);
  p = contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/dropped-onto-stiff-pairs.toml");
  CHECK(count(judge_end(p, way::refactor), fault::exactly) == 1);
}
