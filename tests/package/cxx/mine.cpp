// A C++ program with CONTCT in it: the template, the kernels by name, the comparison.
#include <contct/compare/follower.hpp>
#include <contct/kernel/contct.hpp>
#include <contct/numeric/random.hpp>
#include <contct/outside/registry.hpp>
#include <cstdio>
#include <string>
#include <vector>

namespace {

int checked = 0;
int wrong = 0;

void check(bool holds, const char* what) {
  ++checked;
  if (holds) return;
  ++wrong;
  std::printf("wrong: %s\n", what);
}

/// Two free ends that rise towards faces above them: the first touches after a quarter of the load.
void call_the_template() {
  const std::vector<double> d = {0, 0}, d_star = {2, 1};  // D; what the remaining load would add
  const std::vector<double> faces = {0.5, 0.75};
  const std::vector<int> nodes = {1, 2}, above = {1, 1};
  std::vector<int> status(2, contct::separated);
  std::vector<double> s(2);
  std::vector<contct::event> events(2);
  contct::call<double> c{d, d_star, faces, s, 0, nodes, status, above, {1, 1}};
  const int happened = contct::contct(c, std::span(events));
  check(happened == 1 && events[0] == contct::event{0, contct::change::make}, "the event");
  check(c.smin == 0.25, "SMIN");
  check(s == std::vector{0.25, 0.75}, "SS");
  check(status == std::vector{contct::in_contact, contct::separated}, "ISEP");
}

/// Three dofs a node, the second deflects; a pair of node 2 breaks.
void call_every_kernel() {
  for (const std::string& name : contct::kernel_names()) {
    const std::vector<double> d = {9, 9, 9, 9, 1, 9}, d_star = {9, 9, 9, 9, -8, 9}, faces = {0.5};
    const std::vector<int> nodes = {2}, below = {-1};
    std::vector<int> status = {contct::in_contact};
    std::vector<double> s(1);
    contct::call<double> c{d, d_star, faces, s, 0, nodes, status, below, {2, 3}};
    const auto kernel = contct::make_kernel(name);
    if (kernel->facts().rule != "listing") continue;
    kernel->answer(c);
    check(c.smin == 0.0625 && s[0] == c.smin && status[0] == contct::separated, name.c_str());
    check(kernel->take_text().find("BREAKING CONTACT") != std::string::npos, "the text of unit 26");
  }
}

/// Random calls of one pair, answered by the listing and by the C++ kernel.
void compare_with_the_listing(const char* listing, const char* twin) {
  const auto leader = contct::make_kernel(listing);
  const auto second = contct::make_kernel(twin);
  contct::follower asked(leader->facts(), *second);
  contct::random_numbers random(1989);
  contct::call_outputs answer;
  for (int number = 1; number <= 2000; ++number) {
    const contct::call_inputs<double> in{{random.unit()},
                                         {random.unit() - 0.5},
                                         {random.unit()},
                                         {1},
                                         {contct::separated},
                                         {contct::face_above},
                                         {}};
    contct::call<double> c = answer.prepare(in);
    leader->answer(c);
    const std::string text = leader->take_text();
    (void)asked.ask(number, c, in.isep, text);
  }
  check(asked.compared.values == 2000 * 4 && asked.compared.mismatches == 0, "equal to the bit");
}

}  // namespace

int main() {
  call_the_template();
  call_every_kernel();
  compare_with_the_listing("fortran", "cpp");
  compare_with_the_listing("fortran-r4", "cpp-r4");
  std::printf("%d facts, %d wrong\n", checked, wrong);
  return wrong == 0 ? 0 : 1;
}
