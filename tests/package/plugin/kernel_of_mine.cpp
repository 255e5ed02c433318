// The installed C++ CONTCT as a plug-in: a library of everything that contct::cxx has, behind the ABI of
// plugin.h.
#include <contct/kernel/plugin.h>

#include <contct/kernel/registry.hpp>

using namespace contct;

int contct_kernel_abi() {
  return CONTCT_KERNEL_ABI;
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  const auto dofs = static_cast<std::size_t>(ndof);
  const auto pairs = static_cast<std::size_t>(nc);
  call<double> c{{dd, dofs},  {dtest, dofs}, {cc, pairs},    {ss, pairs},    0,
                 {id, pairs}, {isep, pairs}, {isurf, pairs}, {indof, ndofpn}};
  make_kernel("cpp")->answer(c);
  *smin = c.smin;
}
