// Tests the facts and answers of all kernels, their names, a function as a kernel, calls beyond 32-bit
// integers, the 1989 code, and its text on unit 26, which the C++ kernel writes byte for byte.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <thread>

#include "catch.hpp"
#include "contct/harness/random_calls.hpp"
#include "contct/kernel/child_kernel.hpp"
#include "contct/kernel/fortran.hpp"
#include "contct/kernel/log_text.hpp"
#include "contct/kernel/registry.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

bool same(const call_outputs& a, const call_outputs& b) {
  return same_bits(a.smin, b.smin) && a.isep == b.isep && a.text == b.text && equal_bits(a.ss, b.ss);
}

void halves(const double* /*dd*/, const double* /*dtest*/, const double* /*cc*/, double ss[], double* smin,
            const int* /*id*/, int isep[], const int* /*isurf*/, int nc, int /*indof*/, int /*ndofpn*/,
            int /*ndof*/) {
  std::fill_n(ss, nc, 0.5);
  *smin = 0.5;
  isep[0] = in_contact;
}

void changes_its_input(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                       const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn,
                       int ndof) {
  halves(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof);
  const_cast<double*>(dd)[1] = 3.0;  // NOLINT: what no kernel may do
}

const call_inputs one_pair{{0.0, 0.0}, {-2.0, 0.0}, {-1.0}, {1}, {separated}, {face_below}, {1, 2}};

template <class Real>
small_call<Real>& ask_fortran(small_call<Real>& c) {
  return c.ask_by([](call<Real>& arguments) { fortran::contct(arguments); });
}

/// Returns the texts of gfortran and C++ for one pair at `node` with this gap and response.
template <class Real>
std::pair<std::string, std::string> texts(Real gap, Real response, int node) {
  small_call<Real> c({{Real(0), response, gap}});
  c.dd.assign(static_cast<std::size_t>(node), Real(0));
  c.dtest.assign(static_cast<std::size_t>(node), response);
  c.id = {node};
  fortran::unit_26 log;
  ask_fortran(c);
  c.isep = {separated};
  c.ask();
  call<Real> answered = c.arguments();
  answered.smin = c.smin;
  std::string cpp;
  append_log_text(answered, std::span<const event>(c.events), cpp);
  return {log.take(), cpp};
}

}  // namespace

TEST_CASE("every built-in kernel states its facts, and gives the answer of a hand calculation") {
  REQUIRE(kernel_names().size() >= 4);
  for (const std::string& name : kernel_names()) {
    INFO(name);
    const auto k = make_kernel(name);
    // The facts are available without creating the kernel.
    for (const kernel_facts& facts : {k->facts(), facts_of_kernel(name)}) {
      CHECK(facts.name == name);
      CHECK((facts.real_bytes == 4 || facts.real_bytes == 8));
      CHECK_FALSE(facts.compiler.empty());
      CHECK(facts.rule == k->facts().rule);
      CHECK(facts.has_text == k->facts().has_text);
    }
    small_call<double> c({{0.0, -4.0, -1.0, separated, face_below}, {0.0, 0.0, 1.0}});
    CHECK(c.ask(*k).smin == 0.25);
    CHECK(c.ss == std::vector<double>{0.25, 1.0});
    CHECK(c.isep == std::vector<int>{in_contact, separated});
    CHECK((k->take_text().find("MAKING") != std::string::npos) == k->facts().has_text);
    CHECK(k->take_text().empty());
  }
}

TEST_CASE("a single-precision kernel rounds its input, and returns single-precision numbers as doubles") {
  for (const char* name : {"fortran-r4", "cpp-r4"}) {
    small_call<double> c({{0.0, 3.0 + 1e-12, 1.0}});
    CHECK(c.ask(*make_kernel(name)).smin == static_cast<double>(1.0F / 3.0F));
    CHECK(c.ss[0] == c.smin);
  }
}

TEST_CASE("every built-in kernel gives the same bits for the same calls in another order") {
  constexpr int calls = 500;
  std::vector<call_inputs> inputs;
  call_source source(7, 8);
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
  for (const char* name : {"plugin:./no-such.so", "pipe:no-such-command"}) {
    const kernel_facts facts = facts_of_kernel(name);
    CHECK(facts.name == name);
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

TEST_CASE("a C++ function can be a kernel of the 1989 rule, and such a kernel has no text of unit 26") {
  const auto k = make_function_kernel("halves", halves);
  CHECK(k->facts().name == "halves");
  CHECK(k->facts().language == "a function");
  const call_outputs out = answer_of(*k, one_pair);
  CHECK(out.smin == 0.5);
  CHECK(out.isep[0] == in_contact);
  CHECK(out.text.empty());
}

TEST_CASE("if a kernel function changes its input, this is reported and the answer is not used") {
  const auto k = make_function_kernel("changes", changes_its_input);
  call_outputs out;
  call<double> c = out.prepare(one_pair);
  CHECK_THROWS_WITH(k->answer(c), "changes: changed its input DD");
  CHECK(one_pair.dd[1] == 0.0);
  CHECK(c.smin == not_an_answer);
}

TEST_CASE("the name of a kernel function is refused if it is empty, has a colon or comma, or is taken") {
  for (const char* const name : {"cpp", "fortran", "", "a:b", "a,b"})
    CHECK_THROWS_AS(refuse_name_of_function(name), std::invalid_argument);
  CHECK_NOTHROW(refuse_name_of_function("mine"));
}

TEST_CASE("a call is refused if a dof is outside the arrays, or a dof or ISEP * ISURF exceeds 32 bits") {
  constexpr int least = std::numeric_limits<int>::min();
  using row = std::tuple<int, dof_layout, int, int, const char*>;  // the last one is empty: accepted
  const row rows[] = {
      {2, {1, 1}, 1, -1, ""},
      {1, {2, 2}, 65536, -32768, ""},
      {2, {1, 1}, 46341, 46340, ""},
      {2, {1, 1}, least, 1, ""},
      {0, {3, 2}, 1, 1, ""},  // dof 1
      {2,
       {1, 1},
       65536,
       65536,
       "call: pair 1: found ISEP 65536 and ISURF 65536, whose product is 4294967296; allowed: "
       "a product within 32 bits, -2147483648 to 2147483647"},
      {2, {1, 1}, least, -1, "whose product is 2147483648"},
      {2, {1, 1}, 65536, -32769, "whose product is -2147549184"},
      {3,
       {1, 1},
       1,
       1,
       "call: pair 1: found ID 3, which is dof 3 with INDOF 1 and NDOFPN 1; allowed: a dof from 1 to "
       "2, computed within 32 bits"},
      {0, {1, 1}, 1, 1, "found ID 0, which is dof 0"},
      // The dof would be 1 after a 32-bit overflow.
      {65537, {1, 65536}, 1, 1, "which is dof 4294967297"},
      {65537, {-2147483647, 32768}, 1, 1, "which is dof 1 with INDOF -2147483647"},
      {least, {1, 0}, 1, 1, "which is dof 1 with INDOF 1 and NDOFPN 0"},
  };
  for (const auto& [id, layout, isep, isurf, refused] : rows) {
    const call_inputs in{{0.0, 0.0}, {1.0, 1.0}, {0.5}, {id}, {isep}, {isurf}, layout};
    call_outputs out;
    const call<double> c = out.prepare(in);
    INFO(id << ", " << isep << " * " << isurf);
    if (*refused == '\0')
      CHECK_NOTHROW(refuse_beyond_limits(c, in.isep));
    else
      CHECK_THROWS_WITH(refuse_beyond_limits(c, in.isep), Contains(refused));
  }
}

TEST_CASE("a call of 2147483647 pairs is refused at once, because the loop of the listing would not end") {
  const double one = 0.0;
  call<double> c{};
  c.cc = {&one, 2'147'483'647};
  CHECK_THROWS_WITH(refuse_beyond_limits(c, {}), "call: NC: found 2147483647; allowed: 0 to 2147483646");
}

TEST_CASE("if unit 26 is not requested, the 1989 code writes no text and no file fort.26") {
  small_call<double> c({{0.0, 1.0, 0.25}});
  for (int i = 0; i < 1000; ++i) ask_fortran(c);
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE(
    "each request for the text of unit 26 returns the whole text of the calls since the request before") {
  fortran::unit_26 log;
  auto c = small_call<double>({{0.0, 0.0, 0.25}});
  const std::string line = "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n";
  std::size_t characters = 0;
  for (int take = 0; take < 400; ++take) {
    // The text of 8192 calls fills a whole number of the blocks in which the file is read.
    const int calls = take % 200 == 199 ? 8192 : take % 20;
    std::string written;
    for (int i = 0; i < calls; ++i) {
      ask_fortran(c);
      written += line;
    }
    INFO(take);
    REQUIRE(log.take() == written);
    characters += written.size();
  }
  CHECK(characters > 1'000'000);
}

TEST_CASE("only one object at a time can open unit 26, because unit 26 belongs to the whole process") {
  {
    const fortran::unit_26 log;
    CHECK_THROWS_AS(fortran::unit_26(), std::logic_error);
  }
  CHECK_NOTHROW(fortran::unit_26());
}

TEST_CASE("if a signal ends the process at any moment, no file of unit 26 remains") {
  const auto folder =
      std::filesystem::temp_directory_path() / ("contct-unit26-test-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto own = std::signal(SIGTERM, SIG_DFL);
  for (int i = 0; i < 40; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      setenv("TMPDIR", folder.c_str(), 1);
      while (true) (void)fortran::unit_26();
    }
    usleep(static_cast<useconds_t>(3000 + 37 * i));
    kill(child, SIGTERM);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
  }
  (void)std::signal(SIGTERM, own);
  CHECK(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

TEST_CASE("COMMON /DOF/ is set for every call, so that calls in several threads do not affect each other") {
  const auto many = [](int indof, bool* right) {
    for (int i = 0; i < 20000; ++i) {
      // Node 1 has the dofs 1 to 3, of which only dof `indof` responds.
      small_call<double> c({{0.0, 0.0, 1.0}});
      c.dd.assign(3, 0.0);
      c.dtest.assign(3, 0.0);
      c.dtest[static_cast<std::size_t>(indof) - 1] = 4.0;
      call<double> arguments = c.arguments();
      arguments.dof = {indof, 3};
      fortran::contct(arguments);
      *right = *right && arguments.smin == 0.25;
    }
  };
  bool first = true, second = true;
  std::thread a(many, 1, &first), b(many, 3, &second);
  a.join();
  b.join();
  CHECK(first);
  CHECK(second);
}

TEST_CASE("the C++ kernel writes the text of unit 26 byte for byte as gfortran does") {
  using row = std::tuple<const char*, double, double, int, std::string>;
  const std::string makes = "  ******* MAKING CONTACT ********\n   CONTACT PAIR:   1 NODE: ";
  const std::string no_event = "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n";
  const row rows[] = {
      {"an event", 0.25, 1.0, 7, makes + "  7 SURFACE:   1 SCALE FACTOR =  0.2500E+00\n"},
      {"no event", 3.0, 1.0, 1, no_event},
      {"a node above 999 in FORMAT I3", 0.25, 1.0, 1000,
       makes + "*** SURFACE:   1 SCALE FACTOR =  0.2500E+00\n"},
      {"an exponent of three digits", 1.0, 3e200, 1, makes + "  1 SURFACE:   1 SCALE FACTOR =  0.3333-200\n"},
  };
  for (const auto& [what, gap, response, node, text] : rows) {
    INFO(what);
    CHECK(texts(gap, response, node) == std::pair(text, text));
  }
  CHECK(texts(3.0F, 1.0F, 1) == std::pair(no_event, no_event));
}

TEMPLATE_TEST_CASE("the C++ kernel rounds printed numbers as gfortran does, from the smallest subnormal to 1",
                   "", float, double) {
  using Real = TestType;
  using limits = std::numeric_limits<Real>;
  std::vector<Real> factors = {
      limits::denorm_min(), limits::min(), Real(0.99995), Real(0.999949),   Real(0.09999499),
      Real(0.099995),       Real(0.12345), Real(0.12355), Real(0.00012345), Real(1) - limits::epsilon() / 2};
  for (int e = 1; e < limits::max_exponent10; ++e)
    factors.push_back(Real(1) / Real(3) * std::pow(Real(10), Real(-e)));
  // Ties of the decimal rounding: multiples of 2^-17, whose decimals continue with a 5 after the fourth
  // digit.
  for (int i = 1; i < 400; ++i)
    factors.push_back(static_cast<Real>(i) / Real(131072) * Real(4) + Real(0.0078125));
  int checked = 0;
  for (const Real s : factors) {
    if (!(s > Real(0) && s < Real(1))) continue;
    const auto [f, cpp] = texts(Real(1), Real(1) / s, 1);  // a gap of 1 is never stationary
    REQUIRE(cpp == f);
    ++checked;
  }
  CHECK(checked > 400);
}
