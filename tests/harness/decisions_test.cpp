// Tests the outcomes and margins of the listing's IFs, the branch margin of a report (of the narrowest
// decision on which the first difference depends), and explanations.
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "contct/harness/branches.hpp"
#include "contct/harness/compare.hpp"
#include "contct/harness/explanation.hpp"
#include "contct/harness/random_calls.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/text/input_text.hpp"
#include "support/made_kernel.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

/// Returns the margin of one decision of a call.
std::uint64_t margin_of(small_call<double> c, branch what, std::size_t pair) {
  std::optional<std::uint64_t> margin;
  const answered_call answered = c.ask().answered();
  for_each_decision(answered.c, answered.isep_before, [&](branch b, std::size_t i, bool, double x, double y) {
    if (b == what && i == pair) margin = margin_between(x, y);
  });
  REQUIRE(margin);
  return *margin;
}

/// Pair 1 reaches its face at s = 0.5, pair 2 is 5e-10 from its face, and the dof of pair 3 does not respond.
small_call<double> three_pairs() {
  return small_call<double>({{0.0, 1.0, 0.5}, {0.0, 1e-3, 5e-10}, {0.0, 0.0, 0.25}}).ask();
}

explained_call explained(const std::vector<pair_at<double>>& pairs) {
  double largest = 0.0;
  return explain(small_call<double>(pairs).ask().answered(), 8, largest);
}

}  // namespace

TEST_CASE("true and false outcomes of each IF of the listing are counted separately") {
  small_call<double> c({{0.0, 0.0, 1.0},                    // no response
                        {0.0, 1.0, 0.0, touching, below},   // stationary and pulled: breaks
                        {0.0, -1.0, 0.0, touching, below},  // stationary and pressed: no event
                        {0.0, 1.0, -0.5, apart, below}});   // moving away
  const answered_call answered = c.ask().answered();
  branch_counts counts;
  counts.count(answered.c, answered.isep_before);
  const std::map<branch, std::pair<int, int>> expected = {
      {branch::no_response, {1, 3}},   {branch::stationary, {2, 1}},    {branch::check_positive, {1, 1}},
      {branch::s_positive, {3, 1}},    {branch::s_is_smallest, {1, 2}}, {branch::no_events, {0, 1}},
      {branch::within_epsmul, {1, 3}}, {branch::was_separated, {0, 1}}};
  for (const auto& [what, outcomes] : expected) {
    INFO(branch_names[index_of(what)]);
    CHECK(counts.of(what, true) == outcomes.first);
    CHECK(counts.of(what, false) == outcomes.second);
  }
  CHECK(counts.rarest() == 0);  // neither a call without events nor a make occurred
}

TEST_CASE("the margin of a decision of the listing is its distance to the threshold in ULPs") {
  const double edge = 0.5 + 0.5 / 256;
  using row = std::tuple<const char*, std::vector<pair_at<double>>, branch, std::uint64_t>;
  const row rows[] = {
      {"DIFF at EPSMUL", {{0, 1, 0.5}, {0, 1, edge}}, branch::within_epsmul, 0},
      // Below 2^-8 numbers are 2^-61 apart; one ULP of s = 0.5 is 2^-53, and changes DIFF by 2^-52.
      {"s one ULP inside it", {{0, 1, 0.5}, {0, 1, std::nextafter(edge, 0.0)}}, branch::within_epsmul, 512},
      {"a gap one ULP below EPSGAP", {{0, 1, std::nextafter(1e-10, 0.0)}}, branch::stationary, 1},
      {"a response of +0", {{0, 0.0, 0.5}}, branch::no_response, 0},
      {"a response of -0", {{0, -0.0, 0.5}}, branch::no_response, 0},
      {"the least response", {{0, std::numeric_limits<double>::denorm_min(), 0.5}}, branch::no_response, 1},
      {"D is NaN", {{std::nan(""), 1, 0.5}}, branch::stationary, most},
  };
  for (const auto& [what, pairs, decision, margin] : rows) {
    INFO(what);
    CHECK(margin_of(small_call<double>(pairs), decision, pairs.size() - 1) == margin);
  }
  CHECK(words_of({branch::stationary, 0, false, std::nan(""), 1.0}) ==
        "pair 1: IF (ABS(GAP).LT.EPSGAP) was false, with NaN");
}

TEST_CASE("a gap one ULP below EPSGAP is the narrowest decision, by one ULP, in 8 and in 4 bytes") {
  for (const int bytes : {8, 4}) {
    const double face =
        bytes == 8 ? std::nextafter(1e-10, 0.0) : static_cast<double>(std::nextafter(1e-10F, 0.0F));
    small_call<double> c({{0.0, 1.0, face}});
    double largest = 0.0;
    const auto least = explain(c.ask().answered(), bytes, largest).narrowest;
    REQUIRE(least);
    CHECK(words_of(*least) == "pair 1: IF (ABS(GAP).LT.EPSGAP) was true by 1 ULP");
  }
}

TEST_CASE("the narrowest decision of a wrong answer is one on which the wrong value depends") {
  // SMIN is the number next to 1, so the decision IF (SMIN.EQ.1.) has a narrower margin than any DIFF.
  const small_call<double> late = small_call<double>({{0.0, 1.0, 1.0 - 0x1p-53}, {0.0, 1.0, 4.0}}).ask();
  const small_call<double> odd = small_call<double>({{0.0, 1.0, 0.5, 2, face_above}}).ask();
  CHECK(odd.isep[0] == separated);
  using row = std::tuple<const char*, small_call<double>, std::function<void(call_outputs&)>, const char*>;
  const row rows[] = {
      {"SS of pair 2, although pair 3 is nearer", three_pairs(), [](call_outputs& o) { o.ss[1] = 1e-17; },
       "pair 2: IF (ABS(GAP).LT.EPSGAP) was false by "},
      {"SS of pair 3", three_pairs(), [](call_outputs& o) { o.ss[2] = 0.5; },
       "pair 3: IF (DTEST(NDOF).EQ.0.) was true, exactly on the threshold"},
      {"SMIN and its SS", three_pairs(), [](call_outputs& o) { o.smin = o.ss[1] = 1e-17; },
       "pair 2: IF (ABS(GAP).LT.EPSGAP)"},
      {"SMIN only", three_pairs(), [](call_outputs& o) { o.smin = 1.0; },
       "pair 1: IF (SS(I).LT.SMIN) was true by "},
      {"ISEP of a pair that is toggled wrongly", late, [](call_outputs& o) { o.isep[1] = in_contact; },
       "pair 2: IF (DIFF.LT.EPSMUL) was false by "},
      {"ISEP, if nothing is toggled", late, [](call_outputs& o) { o.isep[0] = separated; },
       "IF (SMIN.EQ.1.) was false by 1 ULP"},
      {"ISEP, if both toggle to different statuses", odd, [](call_outputs& o) { o.isep[0] = in_contact; },
       "pair 1: IF (ISEP(I).EQ.1) was false"},
  };
  for (auto [what, c, change, words] : rows) {
    INFO(what);
    call_outputs other{c.smin, c.ss, c.isep, ""};
    change(other);
    const auto least = narrowest_decision(c.answered(), 8, other);
    REQUIRE(least);
    CHECK_THAT(words_of(*least), StartsWith(words));
  }
}

TEST_CASE("if EPSGAP = 1e-9 makes an SS wrong, this is traced to IF (ABS(GAP).LT.EPSGAP) of the same pair") {
  made_kernel wrong(
      [](call<double>& c) {
        std::vector<event> events(c.cc.size());
        (void)contct::contct(c, std::span<event>(events));
        c.ss[1] = 1e-20 / c.dtest[1];  // the s of a pair at its face
      },
      contact_rule::listing);
  small_call<double> c = three_pairs();
  follower f({"leader", 8, contact_rule::listing, "", "", "", false}, wrong);
  REQUIRE(f.ask(c.answered()));
  CHECK(f.first()->where.field == "SS");
  CHECK_THAT(words_of(*f.first())[1], Contains("pair 2: IF (ABS(GAP).LT.EPSGAP) was false") &&
                                          Contains("this smallest margin is too large for a tie"));
}

TEST_CASE("an explanation gives the winner, the next pair, and why each pair is toggled") {
  using enum why_toggled;
  // Why a pair is toggled, its distance to the face, and the line that set its s.
  using expected_pair = std::tuple<why_toggled, double, listing_line>;
  using expected_call =
      std::tuple<int, int, std::vector<expected_pair>>;  // with the winner and the next pair
  using row = std::tuple<const char*, std::vector<pair_at<double>>, expected_call>;
  const row rows[] = {
      {"within EPSMUL",
       {{0, 1, 0.5}, {0, 1, 0.501}},
       {0, 1, {{winner, 0, listing::moving}, {too_early, 0.001, listing::moving}}}},
      {"s that differ by rounding",
       {{0, 1, 0.5}, {0, 1, std::nextafter(0.5, 1.0)}},
       {0, 1, {{winner, 0, listing::moving}, {same_moment, 0, listing::moving}}}},
      {"near full load, the mark s = 1 of pairs without an event is within EPSMUL",
       {{0, 1, 0.999}, {0, 0, -1, apart, below}, {0, -1, 0, touching, below}},
       {0,
        -1,
        {{winner, 0, listing::moving},
         {by_mark, 1, listing::no_response},
         {by_mark, 0.999, listing::stationary}}}},
      {"SMIN 1e-9 below 256/257: the mark is just outside",
       {{0, 1, 256.0 / 257.0 - 1e-9}, {0, 0, -1, apart, below}},
       {0, -1, {{winner, 0, listing::moving}, {not_toggled, 1, listing::no_response}}}},
      {"a stationary pair wins",
       {{0, 2, 0, touching, below}, {0, 1, 0.5}},
       {0, 1, {{winner, 0, listing::if_check_positive}, {not_toggled, 0.5, listing::moving}}}},
      {"no event", {{0, 1, 2}}, {-1, 0, {{not_toggled, 1, listing::moving}}}},
  };
  for (const auto& [what, pairs, expected] : rows) {
    const explained_call e = explained(pairs);
    INFO(what);
    const auto& [first, next, expected_pairs] = expected;
    CHECK(e.winner == first);
    CHECK(e.next == next);
    REQUIRE(e.pairs.size() == pairs.size());
    for (std::size_t i = 0; i < e.pairs.size(); ++i) {
      const auto& [why, distance, taken] = expected_pairs.at(i);
      CHECK(e.pairs[i].why == why);
      CHECK(e.pairs[i].toggled() == (why != not_toggled));
      CHECK(e.pairs[i].distance == Approx(distance).margin(1e-15));
      CHECK(e.pairs[i].set_s == taken);
    }
  }
}

TEST_CASE("an explanation gives the s of a stationary pair, the winner's lead, and the nearest IF") {
  const explained_call pulled = explained({{0, 2, 0, touching, below}, {0, 1, 0.5}});
  CHECK(pulled.pairs[0].s_chk == 0.5);  // (-1) (-1) / 2
  CHECK(pulled.pairs[0].s == 0.5 * 1e-20);
  CHECK(explained({{0, 1, 0.5}, {0, 1, std::nextafter(0.5, 1.0)}}).ulps_ahead == 1);
  const explained_call quiet = explained({{0, 1, 2}});
  CHECK(quiet.smin == 1.0);
  REQUIRE(quiet.narrowest);
  CHECK(quiet.narrowest->what == branch::no_events);
  CHECK(quiet.narrowest->ulps == 0);
}

TEST_CASE("in 4,000 random calls, the explanation has the toggled pairs, and a winner with s = SMIN") {
  for (const char* name : {"fortran", "cpp-r4"}) {
    const auto k = make_kernel(name);
    call_source calls(1989, 8);
    int events = 0, wrong = 0;
    for (int n = 0; n < 4'000; ++n) {
      const call_inputs& in = calls.random(n);
      call_outputs out;
      call<double> c = out.prepare(in);
      k->answer(c);
      double largest = 0.0;
      const explained_call e = explain({c, in.isep}, k->facts().real_bytes, largest);
      for (std::size_t i = 0; i < in.pairs(); ++i) {
        const bool toggled = in.isep[i] != out.isep[i];
        wrong += e.pairs[i].toggled() != toggled || (e.pairs[i].why != why_toggled::not_toggled) != toggled
                     ? 1
                     : 0;
      }
      events += e.winner >= 0 ? 1 : 0;
      if (e.winner < 0) {
        wrong += c.smin == 1.0 ? 0 : 1;
        continue;
      }
      const explained_pair& winner = e.pairs[static_cast<std::size_t>(e.winner)];
      wrong += same_bits(winner.s, c.smin) && winner.why == why_toggled::winner ? 0 : 1;
    }
    INFO(name);
    CHECK(events > 1'000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("explanations cite lines of the listing with their statements, and each line only once") {
  std::vector<std::string> statements;  // the statement fields, after column 6, without blanks at their ends
  std::istringstream listing(read_input(CONTCT_LISTING));
  for (std::string line; std::getline(listing, line);) {
    line.erase(0, std::min<std::size_t>(6, line.size()));
    const std::size_t from = line.find_first_not_of(' ');
    statements.push_back(
        from == std::string::npos ? "" : line.substr(from, line.find_last_not_of(" \r") - from + 1));
  }
  REQUIRE(statements.size() == 69);
  const std::string header = read_input(CONTCT_CITED_LINES);
  const std::regex line(R"re(listing_line \w+\{(\d+),\s*"(.*)"\};)re");
  std::set<int> cited;
  for (std::sregex_iterator at(header.begin(), header.end(), line); at != std::sregex_iterator(); ++at) {
    const int number = std::stoi((*at)[1]);
    INFO("line " << number);
    REQUIRE((number >= 1 && number <= 69));
    CHECK(statements[number - 1] == (*at)[2]);
    CHECK(cited.insert(number).second);
  }
  CHECK(cited.size() >= 32);
}

TEST_CASE("an explanation has the precision of the call, and only the IFs that the call reached") {
  // A pair before its face, a pair beyond its face, and a pair without response.
  small_call<double> c({{0.1, 1.0, 0.4}, {0.4, 1.0, 0.1}, {0.0, 0.0, 1.0}});
  c.ask();
  double largest = 0.0;
  for (const int bytes : {8, 4}) {
    const explained_call e = explain(c.answered(), bytes, largest);
    CHECK(e.real_bytes == bytes);
    CHECK(e.pairs[0].gap == (bytes == 8 ? 0.4 - 0.1 : static_cast<double>(0.4F - 0.1F)));
    CHECK(e.pairs[1].gap < 0.0);
    const explained_pair& quiet = e.pairs[2];
    CHECK(quiet.set_s == listing::no_response);
    CHECK(quiet.gap == 1.0);
    CHECK(quiet.s_chk == 0.0);
    CHECK(quiet.reached(branch::no_response));
    for (const branch b : {branch::stationary, branch::check_positive, branch::was_separated})
      CHECK_FALSE(quiet.reached(b));
    CHECK_FALSE(e.pairs[1].reached(branch::s_is_smallest));  // the pair's s is negative
  }
}
