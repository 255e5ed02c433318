// listing_battery LIBRARY: every call of the battery, put to the CONTCT of a shared library.
//
// A program of its own, because a copy of the listing may crash, stop or hang. One line a field
// goes to standard output, flushed after every call, so that what came before a crash is known.
// The unit-26 text is left in fort.26 of the working folder, as the listing leaves it.
#include <dlfcn.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "listing/battery.hpp"

namespace contct_test {
namespace {

struct common_dof {
  int indof;
  int ndofpn;
};

using subroutine = void (*)(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                            const int* id, int* isep, const int* isurf, const int* nc);

// What no call may touch or leave behind: the dofs that belong to no pair, and SS and SMIN on entry.
const double foreign_dof = 77.0;
const double unset = -5.0;

/// The arguments of CONTCT, laid out as FORTRAN wants them.
struct arguments {
  std::vector<double> dd, dtest, cc, ss;
  std::vector<int> id, isep, isurf;
  double smin = unset;
  int nc = 0;
};

arguments lay_out(const battery_call& call) {
  arguments a;
  for (const battery_pair& pair : call.pairs) {
    const auto dof = static_cast<std::size_t>((pair.node - 1) * call.ndofpn + call.indof - 1);
    if (a.dd.size() <= dof) {
      a.dd.resize(dof + 1, foreign_dof);
      a.dtest.resize(dof + 1, -foreign_dof);
    }
    a.dd[dof] = pair.d;
    a.dtest[dof] = pair.d_star;
    a.cc.push_back(pair.c);
    a.ss.push_back(unset);
    a.id.push_back(pair.node);
    a.isep.push_back(pair.isep);
    a.isurf.push_back(pair.isurf);
  }
  a.nc = static_cast<int>(call.pairs.size());
  return a;
}

void print_real(const battery_call& call, const std::string& field, double value) {
  const auto bits = static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value));
  std::printf("%s|%s|%016llx\n", call.name.c_str(), field.c_str(), bits);
}

void print_answer(const battery_call& call, const arguments& a) {
  print_real(call, "SMIN", a.smin);
  for (std::size_t i = 0; i < a.ss.size(); ++i)
    print_real(call, "SS(" + std::to_string(i + 1) + ")", a.ss[i]);
  for (std::size_t i = 0; i < a.isep.size(); ++i) {
    std::printf("%s|ISEP(%zu)|%d\n", call.name.c_str(), i + 1, a.isep[i]);
  }
  std::fflush(stdout);
}

int run(const char* library) {
  void* const handle = dlopen(library, RTLD_NOW);
  auto* const contct = handle != nullptr ? reinterpret_cast<subroutine>(dlsym(handle, "contct_")) : nullptr;
  auto* const dof = handle != nullptr ? static_cast<common_dof*>(dlsym(handle, "dof_")) : nullptr;
  if (contct == nullptr || dof == nullptr) {
    std::fprintf(stderr, "no CONTCT with its COMMON /DOF/ in %s\n", library);
    return 1;
  }
  for (const battery_call& call : battery()) {
    arguments a = lay_out(call);
    *dof = {call.indof, call.ndofpn};
    contct(a.dd.data(), a.dtest.data(), a.cc.data(), a.ss.data(), &a.smin, a.id.data(), a.isep.data(),
           a.isurf.data(), &a.nc);
    print_answer(call, a);
  }
  return 0;  // at exit libgfortran writes out unit 26
}

}  // namespace
}  // namespace contct_test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: listing_battery LIBRARY\n", stderr);
    return 1;
  }
  return contct_test::run(argv[1]);
}
