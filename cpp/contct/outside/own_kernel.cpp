#include "contct/outside/own_kernel.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace contct::outside {
namespace {

template <class T>
bool same_bytes(const std::vector<T>& before, std::span<const T> now) {
  return now.empty() || std::memcmp(before.data(), now.data(), now.size_bytes()) == 0;
}

class function_kernel final : public kernel {
 public:
  function_kernel(const std::string& name, kernel_procedure* procedure)
      : facts_(facts_of_outside(name, "a function")), procedure_(procedure) {}
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }
  std::string take_text() override { return {}; }

  /// It gets copies: what it writes where it must not does not reach those who are asked next.
  void answer(call<double>& c) override {
    keep(c.dd, dd_);
    keep(c.dtest, dtest_);
    keep(c.cc, cc_);
    keep(c.id, id_);
    keep(c.isurf, isurf_);
    procedure_(dd_.data(), dtest_.data(), cc_.data(), c.ss.data(), &c.smin, id_.data(), c.isep.data(),
               isurf_.data(), c.nc(), c.dof.indof, c.dof.ndofpn, static_cast<int>(c.dd.size()));
    refuse_change("DD", dd_, c.dd);
    refuse_change("DTEST", dtest_, c.dtest);
    refuse_change("CC", cc_, c.cc);
    refuse_change("ID", id_, c.id);
    refuse_change("ISURF", isurf_, c.isurf);
  }

 private:
  template <class T>
  static void keep(std::span<const T> from, std::vector<T>& to) {
    to.assign(from.begin(), from.end());
  }

  template <class T>
  void refuse_change(const char* what, const std::vector<T>& copy, std::span<const T> before) const {
    if (!same_bytes(copy, before)) throw kernel_failure(facts_.name + ": changed its input " + what);
  }

  kernel_facts facts_;
  kernel_procedure* procedure_;
  std::vector<double> dd_, dtest_, cc_;
  std::vector<int> id_, isurf_;
};

}  // namespace

void refuse_name_of_function(const std::string& name) {
  const std::vector<std::string> known = kernel_names();
  if (name.empty() || name.find_first_of(":,\"") != std::string::npos ||
      std::ranges::find(known, name) != known.end())
    throw std::invalid_argument("name: found \"" + name +
                                "\"; allowed: a name that no kernel has, without colon, comma or quote");
}

std::unique_ptr<kernel> make_function_kernel(const std::string& name, kernel_procedure* procedure) {
  return std::make_unique<function_kernel>(name, procedure);
}

}  // namespace contct::outside
