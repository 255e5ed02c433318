#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

#include "contct/kernel/child_kernel.hpp"

namespace contct {
namespace {

/// A copy of an array between guard bytes, which no kernel may change.
template <class T>
class fenced {
 public:
  fenced(const char* name, std::span<const T> values)
      : name_(name), values_(values), copy_(values.size() + 2 * fence) {
    std::memset(copy_.data(), fence_byte, copy_.size() * sizeof(T));
    std::copy(values.begin(), values.end(), data());
  }
  [[nodiscard]] T* data() { return copy_.data() + fence; }

  /// Describes a forbidden change by the kernel: of guard bytes or, if `is_input`, of the array. Empty if the
  /// kernel made no forbidden change.
  [[nodiscard]] std::string fault(bool is_input) {
    if (!is_intact(copy_.data())) return std::string("wrote before the start of ") + name_;
    if (!is_intact(data() + values_.size())) return std::string("wrote past the end of ") + name_;
    const bool changed = !values_.empty() && std::memcmp(data(), values_.data(), values_.size_bytes()) != 0;
    return is_input && changed ? std::string("changed its input ") + name_ : "";
  }

 private:
  static constexpr std::size_t fence = 256 / sizeof(T);
  static constexpr unsigned char fence_byte = 0xA5;

  static bool is_intact(const T* from) {
    std::array<unsigned char, fence * sizeof(T)> bytes{};
    std::memcpy(bytes.data(), from, bytes.size());
    return std::ranges::all_of(bytes, [](unsigned char b) { return b == fence_byte; });
  }

  const char* name_;
  std::span<const T> values_;
  std::vector<T> copy_;
};

}  // namespace

void put_guarded(call<double>& c, kernel_procedure* procedure) {
  fenced<double> dd("DD", c.dd);
  fenced<double> dtest("DTEST", c.dtest);
  fenced<double> cc("CC", c.cc);
  fenced<double> ss("SS", c.ss);
  fenced<double> smin("SMIN", std::span(&c.smin, 1));
  fenced<int> id("ID", c.id);
  fenced<int> isep("ISEP", c.isep);
  fenced<int> isurf("ISURF", c.isurf);
  procedure(dd.data(), dtest.data(), cc.data(), ss.data(), smin.data(), id.data(), isep.data(), isurf.data(),
            c.nc(), c.dof.indof, c.dof.ndofpn, static_cast<int>(c.dd.size()));
  for (const std::string& fault : {dd.fault(true), dtest.fault(true), cc.fault(true), ss.fault(false),
                                   smin.fault(false), id.fault(true), isep.fault(false), isurf.fault(true)})
    if (!fault.empty()) throw kernel_failure(fault);
  c.smin = *smin.data();
  std::copy_n(ss.data(), c.ss.size(), c.ss.begin());
  std::copy_n(isep.data(), c.isep.size(), c.isep.begin());
}

void refuse_name_of_function(const std::string& name) {
  const std::vector<std::string> known = kernel_names();
  if (name.empty() || name.find_first_of(":,\"") != std::string::npos ||
      std::ranges::find(known, name) != known.end())
    throw std::invalid_argument("name: found \"" + name +
                                "\"; allowed: a new name, without colon, comma or quote");
}

std::unique_ptr<kernel> make_function_kernel(const std::string& name, kernel_procedure* procedure) {
  const auto answer = [name, procedure](call<double>& c, std::string& /*text*/) {
    try {
      put_guarded(c, procedure);
    } catch (const kernel_failure& failure) {
      throw kernel_failure(name + ": " + failure.what());
    }
  };
  return std::make_unique<function_kernel>(facts_of_outside(name, "a function"), answer);
}

}  // namespace contct
