#include "referee/counts.hpp"

#include <sstream>

#include "catch.hpp"

using namespace contct::referee;
using Catch::Matchers::Contains;

TEST_CASE("the counts do not depend on how many threads count") {
  const referee_counts one = judge_many(60, 5, 1);
  const referee_counts three = judge_many(60, 5, 3);
  CHECK(table_of(one) == table_of(three));
  CHECK(one.by_way[0].problems == 60);
  CHECK(one.by_way[0].values > 1000);
  CHECK(one.by_way[2].values > 1000);
}

TEST_CASE("a count above its ceiling, and one below its floor, is a breach") {
  referee_counts c;
  kind_counts& drops = c.by_kind["drops"];
  drops.problems = 10;
  drops.values = 100;
  drops.wrong[static_cast<std::size_t>(fault::outside_force)] = 3;
  std::istringstream file("# words\n[10 1]\n" + ceilings_text(c, 10, 1).substr(7));
  ceilings allowed = read_ceilings(file, 10, 1);
  REQUIRE(allowed.size() == 1);
  CHECK(breaches(c, allowed).empty());

  drops.wrong[static_cast<std::size_t>(fault::outside_force)] = 6;
  CHECK(breaches(c, allowed).empty());
  drops.wrong[static_cast<std::size_t>(fault::outside_force)] = 7;
  CHECK(breaches(c, allowed) == std::vector<std::string>{"drops: out-force: found 7; allowed: at most 6"});
  drops.values = 98;
  CHECK(breaches(c, allowed).size() == 2);
  CHECK(breaches(c, allowed)[0] == "drops: values compared: found 98; allowed: at least 99");
  drops.wrong[static_cast<std::size_t>(fault::refused)] = 1;
  CHECK(breaches(c, allowed).size() == 3);
  drops.wrong[static_cast<std::size_t>(fault::refused)] = 0;
  allowed["pairs-alone"].problems = 1;
  CHECK(breaches(c, allowed).size() == 3);
  CHECK(breaches(c, {}) == std::vector<std::string>{"drops: found no ceilings for this kind"});
}

TEST_CASE("ceilings are those of one count and seed, and a row that is cut short is refused") {
  const std::string row = "drops 1 2 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 7\n";
  std::istringstream two("[10 1]\n" + row + "[20 1]\n" + row + "pairs-alone" + row.substr(5));
  CHECK(read_ceilings(two, 20, 1).size() == 2);
  two.clear();
  two.seekg(0);
  CHECK(read_ceilings(two, 10, 1).at("drops").wrong.back() == 7);
  two.clear();
  two.seekg(0);
  CHECK(read_ceilings(two, 30, 1).empty());
  for (const char* wrong :
       {"[10 1]\ndrops 1 2 0 0\n", "[10 1]\ndrops 1 2 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 7 8\n"}) {
    std::istringstream file(wrong);
    CHECK_THROWS_WITH(read_ceilings(file, 10, 1), Contains("line 2"));
  }
}
