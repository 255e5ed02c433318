// An initial state that its faces contradict: the listing does not notice, and toggles the wrong way
// round. Problem files refuse such states (reference/DIVERGENCES.md, way 5).
#include "catch.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

namespace {

struct pair_answer {
  double s, smin;
  int isep;
};

/// One pair below the structure, at D = 0.
pair_answer ask(const char* kernel, double d_star, double face, int isep) {
  const std::vector<double> d{0.0};
  const std::vector<double> d_test{d_star};
  const std::vector<double> c{face};
  const std::vector<int> node{1};
  const std::vector<int> surface{face_below};
  std::vector<int> status{isep};
  std::vector<double> s{0.0};
  call<double> asked{d, d_test, c, s, 0.0, node, status, surface, {}};
  make_kernel(kernel)->answer(asked);
  return {s[0], asked.smin, status[0]};
}

}  // namespace

TEST_CASE("a separated pair inside the structure stays separated, however deep it is pressed") {
  for (const char* kernel : {"fortran", "cpp"}) {
    const pair_answer a =
        ask(kernel, -1.0, 0.1, separated);  // the face is 0.1 above the structure it is below
    CHECK(a.s == -0.1);
    CHECK(a.smin == 1.0);  // no event: the whole load is applied, and the structure is 1.1 deep
    CHECK(a.isep == separated);
  }
}

TEST_CASE("a separated pair inside the structure makes contact when the structure leaves it") {
  for (const char* kernel : {"fortran", "cpp"}) {
    const pair_answer a = ask(kernel, 1.0, 0.1, separated);
    CHECK(a.smin == 0.1);
    CHECK(a.isep == in_contact);
  }
}

TEST_CASE("a pair in contact off its face breaks when the structure reaches it") {
  for (const char* kernel : {"fortran", "cpp"}) {
    const pair_answer a = ask(kernel, -1.0, -0.1, in_contact);
    CHECK(a.smin == 0.1);
    CHECK(a.isep == separated);
  }
}

TEST_CASE("the corrected kernel closes a pair inside the structure at once") {
  const pair_answer a = ask("corrected", -1.0, 0.1, separated);
  CHECK(a.smin == 0.0);
  CHECK(a.isep == in_contact);
}
