#include "contct/outside/own_kernel.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace contct::outside {
namespace {

thread_local const own_kernel* living = nullptr;  // NOLINT: only own_kernel changes it

template <class T>
bool same_bytes(const std::vector<T>& before, std::span<const T> now) {
  return now.empty() || std::memcmp(before.data(), now.data(), now.size_bytes()) == 0;
}

class function_kernel final : public kernel {
 public:
  function_kernel(kernel_facts facts, kernel_procedure* procedure)
      : facts_(std::move(facts)), procedure_(procedure) {}
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

own_kernel::own_kernel(std::string name, kernel_procedure* procedure)
    : name_(std::move(name)), procedure_(procedure) {
  const std::vector<std::string> known = kernel_names();
  if (name_.empty() || name_.find_first_of(":,\"") != std::string::npos ||
      std::ranges::find(known, name_) != known.end())
    throw std::invalid_argument("name: found \"" + name_ +
                                "\"; allowed: a name that no kernel has, without colon, comma or quote");
  if (living != nullptr)
    throw std::invalid_argument("a kernel of the caller's is being judged already; allowed: one at a time");
  living = this;
}

own_kernel::~own_kernel() {
  living = nullptr;
}

std::unique_ptr<kernel> own_kernel::make() const {
  return std::make_unique<function_kernel>(facts_of(*this), procedure_);
}

const own_kernel* own_kernel::here() {
  return living;
}

}  // namespace contct::outside
