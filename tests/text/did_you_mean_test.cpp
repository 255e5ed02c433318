// What somebody meant who mistyped.
#include "contct/text/did_you_mean.hpp"

#include <vector>

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("edits are counted: put in, left out, replaced, swapped") {
  CHECK(edits_between("stiffness", "stiffness") == 0);
  CHECK(edits_between("stifness", "stiffness") == 1);
  CHECK(edits_between("stiffnesss", "stiffness") == 1);
  CHECK(edits_between("stiffmess", "stiffness") == 1);
  CHECK(edits_between("stfifness", "stiffness") == 1);  // two neighbours swapped
  CHECK(edits_between("", "face") == 4);
  CHECK(edits_between("face", "") == 4);
  CHECK(edits_between("kitten", "sitting") == 3);
  CHECK(edits_between("FACE", "face") == 0);
}

TEST_CASE("edits are the same both ways, and never more than the longer word has letters") {
  const std::vector<std::string> words = {"run", "rnu", "verify", "explain", "", "face", "stiffness"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      CHECK(edits_between(a, b) == edits_between(b, a));
      CHECK(edits_between(a, b) <= static_cast<int>(std::max(a.size(), b.size())));
    }
  }
}

TEST_CASE("the nearest word is meant, and none where too much is wrong") {
  const std::vector<std::string> keys = {"node", "nodes", "surface", "face", "stiffness"};
  CHECK(nearest("stifness", keys) == "stiffness");
  CHECK(nearest("Stiffness", keys) == "stiffness");
  CHECK(nearest("fase", keys) == "face");
  CHECK(nearest("nod", keys) == "node");
  CHECK(nearest("colour", keys).empty());
  CHECK(nearest("", keys).empty());
  CHECK(nearest(std::string(100'000, 's'), keys).empty());
  const std::vector<std::string> one = {"w"};
  CHECK(nearest("x", one).empty());  // all of it would be wrong
  CHECK(did_you_mean("stifness", keys) == " (did you mean \"stiffness\"?)");
  CHECK(did_you_mean("colour", keys).empty());
}
