// Every erratum of reference/errata.toml is undone in turn on a copy of the listing, and what then
// happens is compared with what the file says. An erratum that nothing notices fails.
#include "listing/errata.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "catch.hpp"
#include "listing/battery.hpp"
#include "listing/child.hpp"
#include "listing/edit.hpp"
#include "listing/judge.hpp"
#include "listing/outcome.hpp"
#include "listing/trial.hpp"

using namespace contct_test;

namespace {

std::string listing() {
  return file_text(CONTCT_LISTING);
}

std::vector<erratum> errata() {
  return read_errata(CONTCT_ERRATA);
}

bool occurs(const std::string& part, const std::string& text) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("every erratum undone shows what errata.toml says") {
  const std::string source = listing();
  for (const erratum& e : errata()) {
    for (const undo& u : e.undos) {
      INFO("erratum " << e.number << ", undo: " << u.name);
      const outcome seen = carry_out(u, source);
      CHECK(objection(u, seen).empty());
      SUCCEED(in_words(seen));  // shown with -s
    }
  }
}

TEST_CASE("no erratum goes unnoticed, and only a cosmetic one may hide from everything but the checksum") {
  for (const erratum& e : errata()) {
    INFO("erratum " << e.number);
    CHECK(std::any_of(e.undos.begin(), e.undos.end(),
                      [&](const undo& u) { return u.expect != source_only || e.kind == "cosmetic"; }));
  }
}

TEST_CASE("what errata.toml says was compiled is in the listing, and what the OCR shows in an undone copy") {
  const std::string source = listing();
  for (const erratum& e : errata()) {
    std::string undone;
    for (const undo& u : e.undos) undone += in_one_line(edited(source, u.replace)) + '\n';
    for (const std::string& part : e.compiled) {
      INFO("erratum " << e.number << ", compiled: " << part);
      CHECK(occurs(part, in_one_line(source)));
    }
    for (const std::string& part : e.ocr) {
      INFO("erratum " << e.number << ", ocr: " << part);
      CHECK(occurs(part, undone));
    }
  }
}

TEST_CASE("the errata are numbered from 1, classed, and enough to mean something") {
  const std::set<std::string> classes{"syntax", "semantics", "standard", "cosmetic"};
  const std::set<std::string> confidences{"certain", "likely", "ambiguous"};
  std::map<std::string, int> outcomes;
  long number = 0;
  for (const erratum& e : errata()) {
    CHECK(e.number == ++number);
    CHECK(classes.contains(e.kind));
    CHECK(confidences.contains(e.confidence));
    std::set<std::string> names;
    for (const undo& u : e.undos) {
      CHECK(names.insert(u.name).second);
      ++outcomes[u.expect];
    }
  }
  CHECK(number >= 22);
  for (const std::string& what :
       {does_not_compile, aborts_under_bounds_check, dies, other_numbers, other_text, source_only}) {
    INFO(what);
    CHECK(outcomes[what] >= 1);
  }
  int undos = 0;
  for (const auto& [what, count] : outcomes) undos += count;
  CHECK(undos >= 80);
}

TEST_CASE("the battery is large, its calls have names of their own, and it reaches every line") {
  std::set<std::string> names;
  for (const battery_call& call : battery()) CHECK(names.insert(call.name).second);
  CHECK(names.size() >= 50);

  const behaviour b = try_out(listing(), {});
  CHECK(b.ends_well);
  for (const std::string& name : names) {
    INFO(name);
    CHECK(std::any_of(b.answers.begin(), b.answers.end(), [&](const answer& a) { return a.call == name; }));
  }
  for (const std::string text :
       {"NO EVENTS", "MAKING CONTACT", "BREAKING CONTACT", "CONTACT PAIR:", "NODE: ***"}) {
    INFO(text);
    CHECK(occurs(text, b.text));
  }
}

TEST_CASE("the listing against itself is unnoticed, by the battery and by the checksum") {
  const outcome seen = carry_out({"nothing", {}, {}, source_only, "", ""}, listing());
  CHECK(seen.what == unnoticed);
  CHECK(objection({"nothing", {}, {}, source_only, "", ""}, seen) == "expected source-only; seen unnoticed");
  CHECK_FALSE(objection({"nothing", {}, {}, unnoticed, "", ""}, seen).empty());
}

TEST_CASE("an undo that changes nothing is told from one that does") {
  std::string copy = listing();
  copy.replace(copy.find("C     A checksum"), 5, "C  ...");
  CHECK(classify(try_out(listing(), {}), try_out(copy, {})).what == unnoticed);

  const undo blank{"a blank", {{"SMIN = 1.0", "SMIN  = 1.0"}}, {}, other_text, "", ""};
  CHECK(objection(blank, carry_out(blank, listing())) == "expected other-text; seen source-only");

  const undo comment{"a comment", {{"A checksum", "No checksum"}}, {}, source_only, "", ""};
  CHECK_THROWS_WITH(carry_out(comment, listing()), "in a comment: A checksum");
}

TEST_CASE("an undo that does not say where it applies is refused") {
  CHECK_THROWS_WITH(edited(listing(), {{"SS(2)", "SS(I)"}}), "does not occur: SS(2)");
  CHECK_THROWS_WITH(edited(listing(), {{"SS(I)", "SS(1)"}}), "occurs more than once: SS(I)");
}

TEST_CASE("the right outcome in the wrong place is not accepted") {
  const undo u{"toggle", {{"ISEP(I) = 1\n", "ISEP(I) = 7\n"}}, {}, other_numbers, "one pair breaks",
               "ISEP(1)"};
  const outcome seen = carry_out(u, listing());
  CHECK(objection(u, seen).empty());
  CHECK_FALSE(objection(u, {seen.what, seen.call, "SMIN"}).empty());
  CHECK_FALSE(objection(u, {seen.what, "no pairs", seen.field}).empty());
}

TEST_CASE("a copy that never returns is an outcome") {
  const undo u{
      "endless", {{"SMIN = 1.0\n", "SMIN = 1.0\n    5 GOTO 5\n"}}, {}, dies, "one pair at node 1 makes", ""};
  CHECK(objection(u, carry_out(u, listing())).empty());
}
