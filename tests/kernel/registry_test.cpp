// Kernels by name: built in, plug-ins and commands.
#include "contct/kernel/registry.hpp"

#include <stdexcept>

#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

TEST_CASE("the prefix of a name says which kind of kernel it is, before any is made") {
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

TEST_CASE("a library that is not there is refused when its kernel is made, a command only when it is asked") {
  CHECK_THROWS_WITH(make_kernel("plugin:./no-such.so"), Contains("cannot be loaded"));
  CHECK(make_kernel("pipe:no-such-command")->facts().name == "pipe:no-such-command");
}

TEST_CASE("a prefix alone, and a name that is nearly one, are refused with the names that there are") {
  for (const char* name : {"plugin:", "pipe:", "plugin", ""})
    CHECK_THROWS_AS(make_kernel(name), std::invalid_argument);
  CHECK_THROWS_WITH(facts_of_kernel("fortan"), Contains("no kernel is named \"fortan\"") &&
                                                   Contains("fortran") && Contains("pipe:COMMAND"));
}
