// Tests comparisons of answers and of texts, kernels in lockstep, and the golden set of reference/traces,
// which no program writes. Traces of f2c can be compared without the kernel f2c.
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "catch.hpp"
#include "contct/harness/compare.hpp"
#include "contct/results/path_observers.hpp"
#include "contct/text/input_text.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"

using namespace contct;

namespace {

/// One pair that reaches its face at s = 0.5.
const call_inputs half_way{{0.0}, {1.0}, {0.5}, {1}, {separated}, {face_above}, {}};

/// The leader's answer to the call `half_way`, with the given SMIN.
struct answered_half_way {
  call_outputs out;
  call<double> c = out.prepare(half_way);

  explicit answered_half_way(double smin = 0.5) {
    c.smin = smin;
    c.ss[0] = 0.5;
    c.isep[0] = in_contact;
  }
};

/// Replays a trace of the call `half_way` by `kernel`, with `scale_factor` in its text. Returns the number of
/// mismatches, and the field of the first.
std::pair<std::int64_t, std::string> replayed(const char* kernel, const std::string& scale_factor) {
  trace_header header;
  header.name = kernel;
  std::string text;
  append_header(header, text);
  call_outputs out{0.5,
                   {0.5},
                   {in_contact},
                   "  ******* MAKING CONTACT ********\n"
                   "   CONTACT PAIR:   1 NODE:   1 SURFACE:   1 SCALE FACTOR = " +
                       scale_factor + "\n"};
  append_call(out.answering(half_way, 1), "", text);
  trace_reader calls(text, "a.trace");
  const trace_header h = calls.read_header();
  const auto cpp = make_kernel("cpp");
  follower f = follower_of(h, *cpp);
  (void)replay(calls, f);
  return {f.compared.mismatches, f.first() ? f.first()->where.field : "text"};
}

/// The traces in reference/traces: their names and texts.
std::map<std::string, std::string> golden_set() {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator(CONTCT_TRACES))
    all[entry.path().filename().string()] = read_input(entry.path().string());
  return all;
}

using fault = std::function<void(call<double>&, std::string&)>;

/// Returns the C++ kernel with a fault that `put_in` puts into its answers.
std::unique_ptr<kernel> faulty(const fault& put_in) {
  const std::shared_ptr<kernel> cpp = make_kernel("cpp");
  const auto text = std::make_shared<std::string>();
  const auto answer = [=](call<double>& c) {
    cpp->answer(c);
    *text = cpp->take_text();
    put_in(c, *text);
  };
  return std::make_unique<made_kernel>(answer, contact_rule::listing, text);
}

/// Follows PB1, which has 6 calls of one pair, with FORTRAN as the leader of kernels with these faults.
lockstep_on_path with_faults(const std::vector<fault>& faults) {
  const auto leader = make_kernel("fortran");
  std::vector<std::unique_ptr<kernel>> all;
  for (const fault& f : faults) all.push_back(faulty(f));
  lockstep_on_path compared(leader->facts(), std::move(all));
  (void)cantilever_over_a_stop().run(*leader, {&compared});
  return compared;
}

const fault none = [](call<double>&, std::string&) {};
const fault smin_up = [](call<double>& c, std::string&) { c.smin = std::nextafter(c.smin, 2.0); };
/// The fault `f` in the calls from `first` to `last`.
fault in_calls(int first, int last, fault f) {
  return [first, last, f = std::move(f), n = 0](call<double>& c, std::string& text) mutable {
    if (++n >= first && n <= last) f(c, text);
  };
}

}  // namespace

TEST_CASE("a difference of one bit is a mismatch, except of NaNs, and the first difference is named") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               least = std::numeric_limits<double>::denorm_min();
  const auto other_nan = std::bit_cast<double>(std::bit_cast<std::uint64_t>(nan) + 1);
  using row =
      std::tuple<const char*, double, double, std::vector<double>, std::vector<int>, int, const char*>;
  const row rows[] = {
      {"equal", 0.0, 0.5, {0.5, 0.0}, {1, -1}, 0, ""},
      {"NaN", nan, 0.5, {0.5, nan}, {1, -1}, 0, ""},
      {"-NaN", nan, 0.5, {0.5, -nan}, {1, -1}, 0, ""},
      {"another NaN", nan, 0.5, {0.5, other_nan}, {1, -1}, 0, ""},
      {"one ULP", 0.0, 0.5, {0.5, least}, {1, -1}, 1, "SS(2): 0x0p+0, 0x0.0000000000001p-1022"},
      {"a sign", 0.0, 0.5, {0.5, -0.0}, {1, -1}, 1, "SS(2): 0x0p+0, -0x0p+0"},
      {"a status", 0.0, 0.5, {0.5, 0.0}, {1, 1}, 1, "ISEP(2): -1, 1"},
      {"SMIN and a status", 0.0, 0.25, {0.5, 0.0}, {1, 1}, 2, "SMIN(0): 0x1p-1, 0x1p-2"},
      {"all but SMIN", 0.0, 0.5, {0.25, 1.0}, {-1, 1}, 4, "SS(1): 0x1p-1, 0x1p-2"},
  };
  for (const auto& [what, leader_second, smin, ss, isep, mismatches, found] : rows) {
    tally t;
    const call_outputs leader{0.5, {0.5, leader_second}, {1, -1}, ""};
    const auto m = compare_answers(leader, call_outputs{smin, ss, isep, ""}, t);
    INFO(what);
    CHECK((m ? m->field + "(" + std::to_string(m->index) + "): " + m->leader + ", " + m->follower : "") ==
          found);
    CHECK(t.values == 5);
    CHECK(t.mismatches == mismatches);
    if (what == std::string("one ULP")) CHECK(m->ulps == 1);
  }
}

TEST_CASE("texts of unit 26 are compared byte for byte, and the message names the first line that differs") {
  tally t;
  CHECK_FALSE(compare_text("a\nb\n", "a\nb\n", t));
  const auto line = compare_text("a\nb\nc\n", "a\nB\nc\n", t);
  REQUIRE(line);
  CHECK(line->index == 2);
  CHECK(line->leader == "b");
  const auto missing = compare_text("a\nb\n", "a\n", t);
  REQUIRE(missing);
  CHECK(missing->index == 2);
  CHECK(missing->follower.empty());
  CHECK(compare_text("a\n", "a", t));  // without the last line end
  CHECK(t.values == 4);
  CHECK(t.mismatches == 3);
}

TEST_CASE("texts of equal meaning may differ in blanks and in a number's leading zero only") {
  const char* line = " SCALE FACTOR =  0.2500E+00\n";
  using row = std::tuple<const char*, const char*, bool>;
  const row rows[] = {{line, " SCALE FACTOR =   .2500E+00\n", true},
                      {"-0.5\n", "  -.5\n", true},
                      {line, line, true},
                      {line, " SCALE FACTOR =   .2501E+00\n", false},
                      {line, " SCALE FACTOR =   .2500E+01\n", false},
                      {line, " SCALE FACTOR =  -.2500E+00\n", false},
                      {line, " SCALE FACTOR =\n   .2500E+00\n", false},
                      {line, " SCALE FACTOR =   .2500E+00", false},
                      {line, "", false},
                      {"10.5\n", "1.5\n", false},
                      {"a\n", "a\nb\n", false}};
  for (const auto& [a, b, same] : rows) {
    tally t;
    INFO(a << b);
    CHECK(compare_text(a, b, t, true).has_value() != same);
    CHECK(t.values == 1);
    CHECK(t.mismatches == (same ? 0 : 1));
  }
}

TEST_CASE("unit 26 of gfortran and of C++ is compared by bytes, and only unit 26 of f2c by meaning") {
  for (const std::string& name : kernel_names())
    CHECK(facts_of_kernel(name).text_by_meaning == (name == "f2c"));
  const kernel_facts fortran = facts_of_kernel("fortran");
  kernel_facts without_zeros = facts_of_kernel("cpp");
  CHECK_FALSE(texts_by_meaning(fortran, without_zeros));
  without_zeros.text_by_meaning = true;
  CHECK(texts_by_meaning(fortran, without_zeros));
  CHECK(texts_by_meaning(without_zeros, fortran));
  // The same for a replayed trace.
  using row = std::tuple<const char*, const char*, int>;
  for (const auto& [kernel, scale_factor, mismatches] : {row{"fortran", " 0.5000E+00", 0},
                                                         {"fortran", "  .5000E+00", 1},
                                                         {"another", " 0.5000E+00", 0},
                                                         {"another", "  .5000E+00", 1},
                                                         {"f2c", "  .5000E+00", 0},
                                                         {"f2c", "  .5001E+00", 1},
                                                         {"f2c", "  .5000E+01", 1}}) {
    INFO(kernel << scale_factor);
    CHECK(replayed(kernel, scale_factor) == std::pair<std::int64_t, std::string>(mismatches, "text"));
  }
}

TEST_CASE("a follower counts compared values, and keeps the mismatch of the earliest call") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  const answered_half_way right, wrong(0.25);
  CHECK_FALSE(f.ask({right.c, half_way.isep, {}, 1}));
  CHECK_FALSE(f.first());
  CHECK(f.answer().smin == 0.5);
  CHECK(f.compared.values == 3);
  REQUIRE(f.ask({wrong.c, half_way.isep, {}, 5}));
  CHECK(f.difference()->field == "SMIN");
  CHECK(f.answered());
  CHECK(f.first()->call == 5);
  CHECK(f.first()->narrowest->what == branch::s_is_smallest);
  (void)f.ask({wrong.c, half_way.isep, {}, 6});
  CHECK(f.first()->call == 5);
  CHECK(f.compared.values == 9);
  CHECK(f.compared.mismatches == 2);
}

TEST_CASE("a follower refuses a call that exceeds 32-bit integers, and compares no value of this call") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  answered_half_way asked;
  const std::vector<int> isep = {-2'147'483'647 - 1}, isurf = {face_below};
  asked.c.isurf = isurf;
  CHECK_THROWS_WITH(f.ask({asked.c, isep}), Contains("pair 1: found ISEP -2147483648 and ISURF -1"));
  CHECK(f.compared.values == 0);
}

TEST_CASE("a mismatch report names call, kernels and place, and calls a decision at the threshold a tie") {
  mismatch_report r{3, "fortran", "mine", {"ISEP", 2, "-1", "1", 0}, {}};
  r.narrowest.emplace(branch::within_epsmul, 1, true, 1.0, std::nextafter(1.0, 2.0));
  CHECK(words_of(r)[0] == "call 3: mine differs in ISEP(2): fortran has -1, mine has 1");
  CHECK_THAT(words_of(r)[1], Contains("was true by 1 ULP: a tie"));
  r.narrowest->ulps = tie_ulps + 1;
  CHECK_THAT(words_of(r)[1], Contains("by 5 ULP") && Contains("a bug"));
  r.where = {"answer", 0, "an answer", "it ended with status 3", 0};
  CHECK(words_of(r) == std::vector<std::string>{"call 3: mine gave no answer: it ended with status 3"});
}

TEST_CASE("every kernel gives all answers of the traces to the bit, with every outcome of every IF") {
  std::map<std::string, branch_counts> reached;
  std::map<std::string, std::int64_t> calls;
  for (const auto& [name, text] : golden_set()) {
    for (const std::string& kernel : kernel_names()) {
      trace_reader reader(text, name);
      const trace_header h = reader.read_header();
      const auto asked = make_kernel(kernel);
      if (!comparable(h, asked->facts())) continue;
      follower f = follower_of(h, *asked);
      const std::int64_t number = replay(reader, f, [&](const auto&, const answered_call& right) {
        reached[kernel].count(right.c, right.isep_before);
      });
      INFO(name << ": " << kernel);
      CHECK(f.compared.mismatches == 0);
      CHECK(f.compared.values >= 4 * number);
      calls[kernel] += number;
    }
  }
  for (const char* kernel : {"fortran", "cpp", "fortran-r4", "cpp-r4"}) {
    INFO(kernel);
    CHECK(calls[kernel] > 150);
    CHECK(reached[kernel].rarest() >= 5);
  }
}

TEST_CASE("a committed trace states a purpose, and has the same bytes if it is read and written again") {
  for (const auto& [name, text] : golden_set()) {
    INFO(name);
    CHECK(name.ends_with(".trace"));
    trace_reader reader(text, name);
    const trace_header h = reader.read_header();
    CHECK_FALSE(h.about.empty());
    std::string again;
    append_header(h, again);
    for (recorded_call c; reader.next(c);) append_call(c.answered(), c.note, again);
    CHECK((again == text));
  }
}

TEST_CASE("in lockstep on PB1, a follower's fault is detected in its call and field, and counted") {
  using row = std::tuple<const char*, fault, const char*, int, int, bool>;
  const row rows[] = {
      {"no fault", none, "", 0, 0, true},
      {"one ULP in SMIN of call 2", in_calls(2, 2, smin_up), "SMIN", 2, 1, true},
      // Every call has the leader's inputs, so that one fault gives one mismatch.
      {"ISEP of call 1", in_calls(1, 1, [](call<double>& c, std::string&) { c.isep[0] = in_contact; }),
       "ISEP", 1, 1, true},
      {"every SMIN", smin_up, "SMIN", 1, 6, false},
      {"every SS", [](call<double>& c, std::string&) { c.ss[0] = -c.ss[0]; }, "SS", 1, 6, false},
      {"every ISEP", [](call<double>& c, std::string&) { c.isep[0] = -c.isep[0]; }, "ISEP", 1, 6, false},
      {"every text", [](call<double>&, std::string& text) { text[3] = '?'; }, "text", 1, 6, false},
      {"longer texts", [](call<double>&, std::string& text) { text += "?"; }, "text", 1, 6, false},
      {"no answer", [](call<double>&, std::string&) { throw kernel_failure("it ended with status 3"); },
       "answer", 1, 6, false},
  };
  for (const auto& [what, f, field, call, mismatches, last_call_equal] : rows) {
    const lockstep_on_path compared = with_faults({f});
    INFO(what);
    const auto& first = compared.first();
    CHECK((first ? first->where.field : "") == field);
    CHECK((first ? first->call : 0) == call);
    CHECK((first ? first->follower : "made") == "made");
    CHECK(compared.calls() == 6);
    CHECK(compared.compared().mismatches == mismatches);
    CHECK(compared.last_call_equal() == last_call_equal);
    const nearness& near = compared.followers()[0].near;
    const bool failed = field == std::string("answer");
    CHECK(near.always_answered != failed);
    CHECK(near.same_events == (field != std::string("ISEP") && !failed));
    CHECK(compared.last_answers()[0].failed == failed);
    CHECK(compared.compared().values == (failed ? 6 : 24));  // SMIN, SS, ISEP and text
  }
}

TEST_CASE("for each follower, the differences of SMIN and SS in the last call are counted in ULPs") {
  const fault one_and_two = [](call<double>& c, std::string&) {
    c.smin = std::nextafter(c.smin, 2.0);
    c.ss[0] = std::nextafter(std::nextafter(c.ss[0], 2.0), 2.0);
  };
  // One faulty follower makes the call unequal, whether it is first or last.
  for (const std::size_t place : {0, 1}) {
    const lockstep_on_path compared =
        with_faults(place == 0 ? std::vector{one_and_two, none} : std::vector{none, one_and_two});
    CHECK_FALSE(compared.last_call_equal());
    const std::vector<follower_answer> last = compared.last_answers();
    REQUIRE(last.size() == 2);
    const follower_answer &wrong = last[place], &right = last[1 - place];
    CHECK(std::tuple(wrong.values, wrong.mismatches, wrong.smin_ulps, wrong.ss_ulps) ==
          std::tuple(4, 2, 1U, 2U));
    CHECK(std::tuple(right.values, right.mismatches, right.smin_ulps, right.ss_ulps) ==
          std::tuple(4, 0, 0U, 0U));
    CHECK(compared.followers()[1 - place].compared.mismatches == 0);
    CHECK(compared.followers()[place].near.most_ulps == 2);
    CHECK(compared.followers()[place].near.same_events);
    CHECK(compared.compared().values == 2L * 6 * 4);
  }
}

TEST_CASE("lockstep reports the mismatch of the earliest call, in any order of the followers") {
  const fault early = in_calls(2, 6, smin_up), late = in_calls(4, 6, smin_up);
  for (const auto& faults : {std::vector{early, late}, std::vector{late, early}}) {
    const lockstep_on_path compared = with_faults(faults);
    REQUIRE(compared.first());
    CHECK(compared.first()->call == 2);
  }
}
