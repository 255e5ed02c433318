// Kernels are functions of one call: asked again, in any order, they give the same bits.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/number/bits.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

bool same(const call_outputs& a, const call_outputs& b) {
  return same_bits(a.smin, b.smin) && a.isep == b.isep && a.text == b.text &&
         std::equal(a.ss.begin(), a.ss.end(), b.ss.begin(), b.ss.end(),
                    [](double x, double y) { return same_bits(x, y); });
}

}  // namespace

TEST_CASE("every kernel gives the same bits when it is asked again, in another order") {
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
