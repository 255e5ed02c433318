// A C++ program that calls CONTCT by its template and by the names of kernels.
#include <contct/kernel/call.hpp>
#include <contct/kernel/contct.hpp>
#include <contct/kernel/registry.hpp>
#include <cstdio>
#include <vector>

using namespace contct;

int main() {
  // Two free ends rise towards faces above them. The first end reaches its face at a quarter of the load.
  const std::vector<double> d = {0, 0}, d_star = {2, 1};  // D, and its change by the remaining load
  const std::vector<double> faces = {0.5, 0.75};
  const std::vector<int> nodes = {1, 2}, above = {1, 1};
  std::vector<int> status(2, separated);
  std::vector<double> s(2);
  std::vector<event> events(2);
  call<double> c{d, d_star, faces, s, 0, nodes, status, above, {1, 1}};
  const int happened = contct::contct(c, std::span(events));
  const auto is_answered = [&] {
    return c.smin == 0.25 && s == std::vector{0.25, 0.75} && status == std::vector{in_contact, separated};
  };
  int facts = 1;
  int wrong = happened == 1 && events[0] == event{0, change::make} && is_answered() ? 0 : 1;
  for (const std::string& name : kernel_names()) {
    status.assign(2, separated);
    make_kernel(name)->answer(c);
    ++facts;
    wrong += is_answered() ? 0 : 1;
  }
  std::printf("%d facts, %d wrong\n", facts, wrong);
  return wrong;
}
