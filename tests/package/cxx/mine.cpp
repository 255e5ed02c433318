// A C++ program with CONTCT in it: the template, the kernels by name, the comparison.
#include <cmath>
#include <contct/compare/compare.hpp>
#include <contct/kernel/call.hpp>
#include <contct/kernel/contct.hpp>
#include <contct/kernel/registry.hpp>
#include <cstdio>
#include <vector>

using namespace contct;

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
  std::vector<int> status(2, separated);
  std::vector<double> s(2);
  std::vector<event> events(2);
  call<double> c{d, d_star, faces, s, 0, nodes, status, above, {1, 1}};
  const int happened = contct::contct(c, std::span(events));
  check(happened == 1 && events[0] == event{0, change::make}, "the event");
  check(c.smin == 0.25, "SMIN");
  check(s == std::vector{0.25, 0.75}, "SS");
  check(status == std::vector{in_contact, separated}, "ISEP");
}

/// Three dofs a node, the second deflects; a pair of node 2 breaks.
void call_every_kernel() {
  for (const std::string& name : kernel_names()) {
    const std::vector<double> d = {9, 9, 9, 9, 1, 9}, d_star = {9, 9, 9, 9, -8, 9}, faces = {0.5};
    const std::vector<int> nodes = {2}, below = {-1};
    std::vector<int> status = {in_contact};
    std::vector<double> s(1);
    call<double> c{d, d_star, faces, s, 0, nodes, status, below, {2, 3}};
    const auto kernel = make_kernel(name);
    if (kernel->facts().rule != contct::contact_rule::listing) continue;
    kernel->answer(c);
    check(c.smin == 0.0625 && s[0] == c.smin && status[0] == separated, name.c_str());
    check(kernel->take_text().find("BREAKING CONTACT") != std::string::npos, "the text of unit 26");
  }
}

/// The listing and C++ in one precision on 2000 calls of 20 pairs, to the bit.
void compare_with_the_listing(const char* listing, const char* twin) {
  const auto fortran = make_kernel(listing);
  const auto cpp = make_kernel(twin);
  call_inputs<double> in;
  for (int i = 0; i < 20; ++i) {
    in.dd.push_back(0);
    in.dtest.push_back(0);
    in.cc.push_back(0.25 * (i % 7));
    in.id.push_back(i + 1);
    in.isep.push_back(separated);
    in.isurf.push_back(face_above);
  }
  tally compared;
  for (int round = 1; round <= 2000; ++round) {
    for (int i = 0; i < 20; ++i) in.dtest[i] = std::sin(round * (i + 1.0));
    call_outputs one, other;
    call<double> of_fortran = one.prepare(in), of_cpp = other.prepare(in);
    fortran->answer(of_fortran);
    cpp->answer(of_cpp);
    (void)compare_answers(answer<double>{of_fortran.smin, one.ss, one.isep},
                          answer<double>{of_cpp.smin, other.ss, other.isep}, compared);
    (void)compare_text(fortran->take_text(), cpp->take_text(), compared);
  }
  check(compared.values > 50'000 && compared.mismatches == 0, "equal to the bit");
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
