#include "contct/lab/epsmul_variants.hpp"

#include <cstdio>
#include <mutex>
#include <string>

#include "contct/kernel/fortran.hpp"
#include "contct/outside/registry.hpp"

extern "C" {
int contct_epsmul_variants(void);
double contct_epsmul_of(int variant);
void contct_call_epsmul(int variant, const double* dd, const double* dtest, const double* cc, double* ss,
                        double* smin, const int* id, int* isep, const int* isurf, int nc, int indof,
                        int ndofpn);
}

namespace contct::lab {
namespace {

class epsmul_variant final : public kernel {
 public:
  explicit epsmul_variant(int variant) : variant_(variant), facts_(facts_of_kernel("fortran")) {
    char epsmul[24];
    (void)std::snprintf(epsmul, sizeof epsmul, "%g", contct_epsmul_of(variant));
    facts_.name += std::string(" with EPSMUL ") + epsmul;
    facts_.has_text = false;
  }
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }

  void answer(call<double>& c) override {
    const std::scoped_lock lock(fortran::process_wide());
    contct_call_epsmul(variant_, c.dd.data(), c.dtest.data(), c.cc.data(), c.ss.data(), &c.smin, c.id.data(),
                       c.isep.data(), c.isurf.data(), c.nc(), c.dof.indof, c.dof.ndofpn);
  }

  std::string take_text() override { return {}; }

 private:
  int variant_;  // from 1, as FORTRAN counts
  kernel_facts facts_;
};

}  // namespace

std::vector<double> epsmul_of_variants() {
  std::vector<double> values;
  for (int variant = 1; variant <= contct_epsmul_variants(); ++variant)
    values.push_back(contct_epsmul_of(variant));
  return values;
}

std::unique_ptr<kernel> make_epsmul_variant(std::size_t variant) {
  return std::make_unique<epsmul_variant>(static_cast<int>(variant) + 1);
}

}  // namespace contct::lab
