// Tests the facts and answers of all kernels, and the names of built-in kernels, plug-ins and commands.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/number/bits.hpp"
#include "support/one_pair.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

bool same(const call_outputs& a, const call_outputs& b) {
  return same_bits(a.smin, b.smin) && a.isep == b.isep && a.text == b.text &&
         std::equal(a.ss.begin(), a.ss.end(), b.ss.begin(), b.ss.end(),
                    [](double x, double y) { return same_bits(x, y); });
}

}  // namespace

TEST_CASE("every built-in kernel can be created, and states a name, a precision and a compiler") {
  const auto names = kernel_names();
  REQUIRE(names.size() >= 4);
  for (const std::string& name : names) {
    const auto k = make_kernel(name);
    CHECK(k->facts().name == name);
    CHECK((k->facts().real_bytes == 4 || k->facts().real_bytes == 8));
    CHECK_FALSE(k->facts().compiler.empty());
    // The facts are available without creating the kernel.
    const kernel_facts facts = facts_of_kernel(name);
    CHECK(facts.name == name);
    CHECK(facts.real_bytes == k->facts().real_bytes);
    CHECK(facts.rule == k->facts().rule);
    CHECK(facts.has_text == k->facts().has_text);
  }
}

TEST_CASE("every built-in kernel gives the answer of a hand calculation") {
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

TEST_CASE(
    "a single-precision kernel rounds the input of a call, and returns single-precision numbers as doubles") {
  for (const char* name : {"fortran-r4", "cpp-r4"}) {
    const auto k = make_kernel(name);
    small_call<double> c({{0.0, 3.0 + 1e-12, 1.0, separated, face_above}});
    call<double> arguments = c.arguments();
    k->answer(arguments);
    CHECK(arguments.smin == static_cast<double>(1.0F / 3.0F));
    CHECK(c.ss[0] == arguments.smin);
  }
}

TEST_CASE("every built-in kernel gives the same bits for the same calls in another order") {
  constexpr int calls = 2000;
  std::vector<call_inputs<double>> inputs;
  random_calls<double> source(7);
  for (int i = 0; i < calls; ++i) inputs.push_back(source.random(i));
  for (const std::string& name : kernel_names()) {
    INFO(name);
    const auto k = make_kernel(name);
    std::vector<call_outputs> first;
    for (int i = 0; i < calls; ++i) first.push_back(answer_of(*k, inputs[i]));
    int events = 0;
    for (int i = calls - 1; i >= 0; --i) {
      REQUIRE(same(answer_of(*k, inputs[i]), first[i]));
      REQUIRE(same(answer_of(*k, inputs[i]), first[i]));
      events += first[i].isep != inputs[i].isep ? 1 : 0;
    }
    CHECK(events > calls / 10);
  }
}

TEST_CASE("before a kernel is created, precision, rule and text are known from the prefix of its name") {
  const kernel_facts plugin = facts_of_kernel("plugin:./no-such.so");
  CHECK(plugin.name == "plugin:./no-such.so");
  const kernel_facts pipe = facts_of_kernel("pipe:no-such-command");
  CHECK(pipe.name == "pipe:no-such-command");
  for (const kernel_facts& facts : {plugin, pipe}) {
    CHECK(facts.real_bytes == 8);
    CHECK(facts.rule == contact_rule::listing);
    CHECK_FALSE(facts.has_text);
    CHECK_FALSE(facts.text_by_meaning);
  }
  CHECK(facts_of_kernel("fortran").has_text);
}

TEST_CASE("a prefix without a name and a misspelt kernel name are refused, with a list of valid names") {
  for (const char* name : {"plugin:", "pipe:", "plugin", ""})
    CHECK_THROWS_AS(make_kernel(name), std::invalid_argument);
  CHECK_THROWS_WITH(facts_of_kernel("fortan"), Contains("no kernel is named \"fortan\"") &&
                                                   Contains("fortran") && Contains("pipe:COMMAND"));
}
