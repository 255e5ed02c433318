// Tests a function of this process as a kernel.
#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "contct/kernel/child_kernel.hpp"

using namespace contct;

namespace {

call_inputs<double> one_pair() {
  return {{0.0, 0.0}, {-2.0, 0.0}, {-1.0}, {1}, {separated}, {face_below}, {1, 2}};
}

void halves(const double* /*dd*/, const double* /*dtest*/, const double* /*cc*/, double ss[], double* smin,
            const int* /*id*/, int isep[], const int* /*isurf*/, int nc, int /*indof*/, int /*ndofpn*/,
            int /*ndof*/) {
  for (int i = 0; i < nc; ++i) ss[i] = 0.5;
  *smin = 0.5;
  isep[0] = in_contact;
}

void changes_its_input(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                       const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn,
                       int ndof) {
  halves(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof);
  const_cast<double*>(dd)[1] = 3.0;  // NOLINT: what no kernel may do
}

}  // namespace

TEST_CASE("a C++ function can be a kernel of the 1989 rule, and such a kernel has no text of unit 26") {
  const auto k = make_function_kernel("halves", halves);
  CHECK(k->facts().name == "halves");
  CHECK(k->facts().language == "a function");
  const call_inputs<double> in = one_pair();
  call_outputs out;
  call<double> c = out.prepare(in);
  k->answer(c);
  CHECK(c.smin == 0.5);
  CHECK(out.isep[0] == in_contact);
  CHECK(k->take_text().empty());
}

TEST_CASE(
    "if a kernel function changes the input of a call, the change is reported and the answer is not used") {
  const auto k = make_function_kernel("changes", changes_its_input);
  const call_inputs<double> in = one_pair();
  call_outputs out;
  call<double> c = out.prepare(in);
  CHECK_THROWS_WITH(k->answer(c), "changes: changed its input DD");
  CHECK(in.dd[1] == 0.0);
  CHECK(c.smin == not_an_answer);
}

TEST_CASE("the name of a kernel function is refused if it is empty, has a colon or comma, or is taken") {
  for (const char* const name : {"cpp", "fortran", "", "a:b", "a,b"})
    CHECK_THROWS_AS(refuse_name_of_function(name), std::invalid_argument);
  CHECK_NOTHROW(refuse_name_of_function("mine"));
}
