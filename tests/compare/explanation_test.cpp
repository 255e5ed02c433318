// Tests the explanations of why pairs are toggled, and the lines of the listing that the explanations cite.
#include "contct/compare/explanation.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/number/bits.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

explained_call explained(small_call<double> c, double largest = 0.0) {
  return explain(c.ask().answered(), 8, largest);
}

/// Returns the statement field of a fixed-form line, after column 6, without blanks at its ends.
std::string statement_of(const std::string& line) {
  constexpr std::size_t label_and_mark = 6;
  const std::size_t from = line.find_first_not_of(' ', label_and_mark);
  return from == std::string::npos ? "" : line.substr(from, line.find_last_not_of(" \r") - from + 1);
}

std::vector<std::string> listing_text() {
  std::vector<std::string> lines;
  std::ifstream file(CONTCT_LISTING);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE(
    "an explanation says that a pair within EPSMUL is toggled too early, and gives the distance to the "
    "face") {
  const explained_call e = explained(
      small_call<double>({{0.0, 1.0, 0.5, separated, face_above}, {0.0, 1.0, 0.501, separated, face_above}}));
  CHECK(e.winner == 0);
  CHECK(e.next == 1);
  CHECK(e.pairs[0].why == why_toggled::winner);
  CHECK(e.pairs[1].why == why_toggled::too_early);
  CHECK(e.pairs[1].distance == Approx(0.001));
  CHECK(e.pairs[1].toggled());
}

TEST_CASE(
    "if the s of two pairs differ only by rounding, the explanation says that both reach their faces "
    "together") {
  const explained_call e = explained(small_call<double>(
      {{0.0, 1.0, 0.5, separated, face_above}, {0.0, 1.0, std::nextafter(0.5, 1.0), separated, face_above}}));
  CHECK(e.pairs[1].why == why_toggled::same_moment);
  CHECK(e.ulps_ahead == 1);
}

TEST_CASE(
    "near full load, the mark s = 1 of a pair without an event is within EPSMUL of SMIN, so the pair is "
    "toggled") {
  const explained_call e = explained(small_call<double>({{0.0, 1.0, 0.999, separated, face_above},
                                                         {0.0, 0.0, -1.0, separated, face_below},
                                                         {0.0, -1.0, 0.0, in_contact, face_below}}));
  CHECK(e.winner == 0);
  CHECK(e.next == -1);  // no other pair has an event
  CHECK(e.pairs[1].way == listing_branch::no_response);
  CHECK(e.pairs[1].why == why_toggled::by_mark);
  CHECK(e.pairs[1].distance == 1.0);
  CHECK(e.pairs[2].way == listing_branch::stationary);
  CHECK(e.pairs[2].why == why_toggled::by_mark);
}

TEST_CASE("if SMIN is 1e-9 below 256/257, the mark s = 1 of a pair without an event is just outside EPSMUL") {
  const explained_call e = explained(small_call<double>(
      {{0.0, 1.0, 256.0 / 257.0 - 1e-9, separated, face_above}, {0.0, 0.0, -1.0, separated, face_below}}));
  CHECK(e.pairs[1].why == why_toggled::not_toggled);
  CHECK_FALSE(e.pairs[1].toggled());
}

TEST_CASE(
    "if a stationary pair wins, its s is the check variable times DELTA, and no advancing pair is within "
    "EPSMUL") {
  const explained_call e = explained(
      small_call<double>({{0.0, 2.0, 0.0, in_contact, face_below}, {0.0, 1.0, 0.5, separated, face_above}}));
  CHECK(e.winner == 0);
  CHECK(e.pairs[0].way == listing_branch::stationary_event);
  CHECK(e.pairs[0].s_chk == 0.5);  // (-1) (-1) / 2
  CHECK(e.pairs[0].s == 0.5 * 1e-20);
  CHECK(e.next == 1);
  CHECK(e.pairs[1].why == why_toggled::not_toggled);
}

TEST_CASE(
    "if a call has no event, the explanation has no winner and gives the IF that is nearest to its "
    "threshold") {
  const explained_call e = explained(small_call<double>({{0.0, 1.0, 2.0, separated, face_above}}));
  CHECK(e.smin == 1.0);
  CHECK(e.winner == -1);
  REQUIRE(e.narrowest);
  CHECK(e.narrowest->what == branch::no_events);
  CHECK(e.narrowest->ulps == 0);
}

TEST_CASE(
    "in 20,000 random calls, the explanation names a winner whose s is SMIN, and the toggled pairs of the "
    "kernel") {
  const auto agree = [](const auto& in, const call_outputs& out, const explained_call& e) {
    for (std::size_t i = 0; i < in.pairs(); ++i) {
      const explained_pair& p = e.pairs[i];
      if (p.toggled() != (in.isep[i] != out.isep[i])) return false;
      if (p.toggled() != (p.why != why_toggled::not_toggled)) return false;
    }
    if (e.winner < 0) return out.smin == 1.0;
    return same_bits(e.pairs[static_cast<std::size_t>(e.winner)].s, out.smin) &&
           e.pairs[static_cast<std::size_t>(e.winner)].why == why_toggled::winner;
  };
  for (const char* name : {"fortran", "cpp-r4"}) {
    const auto k = make_kernel(name);
    random_calls<double> calls(1989);
    int events = 0;
    int wrong = 0;
    for (int n = 0; n < 20'000; ++n) {
      const call_inputs<double>& in = calls.random(n);
      call_outputs out;
      call<double> c = out.prepare(in);
      k->answer(c);
      out.smin = c.smin;
      double largest = 0.0;
      const explained_call e = explain({c, in.isep}, k->facts().real_bytes, largest);
      events += e.winner >= 0 ? 1 : 0;
      wrong += agree(in, out, e) ? 0 : 1;
    }
    INFO(name);
    CHECK(events > 5'000);
    CHECK(wrong == 0);
  }
}

TEST_CASE(
    "explanations cite lines of the listing with the statements of these lines, and no line is listed "
    "twice") {
  const std::vector<std::string> text = listing_text();
  REQUIRE(text.size() == 69);
  std::ifstream file(CONTCT_CITED_LINES);
  const std::string header(std::istreambuf_iterator<char>(file), {});
  const std::regex line(R"re(listing_line \w+\{(\d+),\s*"(.*)"\};)re");
  std::set<int> cited;
  for (std::sregex_iterator at(header.begin(), header.end(), line); at != std::sregex_iterator(); ++at) {
    const int number = std::stoi((*at)[1]);
    INFO("line " << number);
    REQUIRE(number >= 1);
    REQUIRE(number <= static_cast<int>(text.size()));
    CHECK(statement_of(text[number - 1]) == (*at)[2]);
    CHECK(cited.insert(number).second);
  }
  CHECK(cited.size() >= 32);
}

TEST_CASE(
    "an explanation is computed in the precision of the call, and has only the IFs that the call reached") {
  // A pair before its face, a pair beyond its face, and a pair without response.
  small_call<double> c({{0.1, 1.0, 0.4, separated, face_above},
                        {0.4, 1.0, 0.1, separated, face_above},
                        {0.0, 0.0, 1.0, separated, face_above}});
  c.ask();
  double largest = 0.0;
  for (const int bytes : {8, 4}) {
    const explained_call e = explain(c.answered(), bytes, largest);
    CHECK(e.real_bytes == bytes);
    CHECK(e.pairs[0].gap == (bytes == 8 ? 0.4 - 0.1 : static_cast<double>(0.4F - 0.1F)));
    CHECK(e.pairs[1].gap < 0.0);
    const explained_pair& quiet = e.pairs[2];
    CHECK(quiet.way == listing_branch::no_response);
    CHECK(quiet.gap == 1.0);
    CHECK(quiet.s_chk == 0.0);
    CHECK(quiet.at(branch::no_response).reached);
    CHECK_FALSE(quiet.at(branch::stationary).reached);
    CHECK_FALSE(quiet.at(branch::check_positive).reached);
    CHECK_FALSE(quiet.at(branch::was_separated).reached);
    CHECK_FALSE(e.pairs[1].at(branch::s_is_smallest).reached);  // the pair's s is negative
  }
}
