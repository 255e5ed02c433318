#include <stdexcept>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "support/one_pair.hpp"

using namespace contct;

TEST_CASE("every kernel built in can be made, and says what it is") {
  const auto names = kernel_names();
  REQUIRE(names.size() >= 4);
  for (const std::string& name : names) {
    const auto k = make_kernel(name);
    CHECK(k->facts().name == name);
    CHECK((k->facts().real_bytes == 4 || k->facts().real_bytes == 8));
    CHECK_FALSE(k->facts().compiler.empty());
    // The facts can be had without the kernel, and while it lives.
    const kernel_facts facts = facts_of_kernel(name);
    CHECK(facts.name == name);
    CHECK(facts.real_bytes == k->facts().real_bytes);
    CHECK(facts.rule == k->facts().rule);
    CHECK(facts.has_text == k->facts().has_text);
  }
}

TEST_CASE("every kernel gives the hand-worked answer") {
  for (const std::string& name : kernel_names()) {
    const auto k = make_kernel(name);
    small_call<double> c({{0.0, -4.0, -1.0, separated, face_below}, {0.0, 0.0, 1.0, separated, face_above}});
    call<double> arguments = c.arguments();
    k->answer(arguments);
    INFO(name);
    CHECK(arguments.smin == 0.25);
    CHECK(c.ss == std::vector<double>{0.25, 1.0});
    CHECK(c.isep == std::vector<int>{in_contact, separated});
    CHECK((k->take_text().find("MAKING") != std::string::npos) == k->facts().has_text);
    CHECK(k->take_text().empty());
  }
}

TEST_CASE("a single-precision kernel sees the doubles rounded and gives its numbers back exactly") {
  for (const char* name : {"fortran-r4", "cpp-r4"}) {
    const auto k = make_kernel(name);
    small_call<double> c({{0.0, 3.0 + 1e-12, 1.0, separated, face_above}});
    call<double> arguments = c.arguments();
    k->answer(arguments);
    CHECK(arguments.smin == static_cast<double>(1.0F / 3.0F));
    CHECK(c.ss[0] == arguments.smin);
  }
}

TEST_CASE("messages call the rule of the listing the 1989 rule") {
  CHECK(rule_words(contact_rule::listing) == "the 1989 rule");
  CHECK(rule_words(contact_rule::corrected) == "the corrected rule");
}
