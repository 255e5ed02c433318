#include "contct/kernel/built_in.hpp"

#include <type_traits>
#include <utility>

#include "contct/kernel/contct.hpp"
#include "contct/kernel/corrected.hpp"
#include "contct/kernel/fortran.hpp"
#include "contct/kernel/log_text.hpp"

namespace contct::kernels {
namespace {

const char* const cxx_compiler = CONTCT_CXX_COMPILER;    // NOLINT: set by CMake
const char* const cxx_flags = CONTCT_CXX_FLAGS;          // NOLINT: set by CMake
const char* const fortran_flags = CONTCT_FORTRAN_FLAGS;  // NOLINT: set by CMake

/// C++ CONTCT, with its text.
template <class Real>
class cpp_implementation {
 public:
  static constexpr const char* name = std::is_same_v<Real, float> ? "cpp-r4" : "cpp";
  static constexpr const char* language = "C++20";
  static const char* compiler() { return cxx_compiler; }
  static std::string flags() { return cxx_flags; }

  void answer(call<Real>& c) {
    if (events_.size() < c.cc.size()) events_.resize(c.cc.size());
    const int happened = contct(c, std::span<event>(events_));
    append_log_text(c, std::span<const event>(events_.data(), happened), text_);
  }

  std::string take_text() { return std::exchange(text_, {}); }

 private:
  std::vector<event> events_;
  std::string text_;
};

/// The 1989 code, with unit 26 kept while this kernel lives.
template <class Real>
class fortran_implementation {
 public:
  static constexpr const char* name = std::is_same_v<Real, float> ? "fortran-r4" : "fortran";
  static constexpr const char* language = "FORTRAN 77";
  static const char* compiler() { return fortran::gfortran.compiler; }
  static std::string flags() {
    return std::string(fortran_flags) + (std::is_same_v<Real, double> ? " -fdefault-real-8" : "");
  }

  void answer(call<Real>& c) { fortran::contct(c); }
  std::string take_text() { return log_.take(); }

 private:
  fortran::unit_26 log_;
};

template <class Implementation>
kernel_facts facts_of_listing(int real_bytes) {
  return {
      Implementation::name,    real_bytes, "listing", Implementation::language, Implementation::compiler(),
      Implementation::flags(), true};
}

template <template <class> class Implementation>
class kernel_r8 final : public kernel {
 public:
  static kernel_facts what_it_is() { return facts_of_listing<Implementation<double>>(8); }
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }
  void answer(call<double>& c) override { inner_.answer(c); }
  std::string take_text() override { return inner_.take_text(); }

 private:
  kernel_facts facts_ = what_it_is();
  Implementation<double> inner_;
};

/// The listing as printed, behind a double-precision boundary.
template <template <class> class Implementation>
class kernel_r4 final : public kernel {
 public:
  static kernel_facts what_it_is() { return facts_of_listing<Implementation<float>>(4); }
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }

  void answer(call<double>& c) override {
    round_inputs(c);
    call<float> narrow{dd_, dtest_, cc_, ss_, 0.0F, c.id, c.isep, c.isurf, c.dof};
    inner_.answer(narrow);
    for (std::size_t i = 0; i < c.ss.size(); ++i) c.ss[i] = ss_[i];
    c.smin = narrow.smin;
  }

  std::string take_text() override { return inner_.take_text(); }

 private:
  /// Only the dofs that pairs watch are rounded: the rest is never read.
  void round_inputs(const call<double>& c) {
    dd_.resize(c.dd.size());
    dtest_.resize(c.dtest.size());
    cc_.assign(c.cc.begin(), c.cc.end());
    ss_.resize(c.ss.size());
    for (const int node : c.id) {
      const std::size_t dof = c.dof.dof_of(node) - 1;
      dd_[dof] = static_cast<float>(c.dd[dof]);
      dtest_[dof] = static_cast<float>(c.dtest[dof]);
    }
  }

  kernel_facts facts_ = what_it_is();
  Implementation<float> inner_;
  std::vector<float> dd_, dtest_, cc_, ss_;
};

/// The corrected rule. It writes no text.
class corrected_kernel final : public kernel {
 public:
  static kernel_facts what_it_is() {
    return {"corrected", 8, "corrected", "C++20", cxx_compiler, cxx_flags, false};
  }
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }

  void answer(call<double>& c) override { contct_corrected_quick(c); }
  std::string take_text() override { return {}; }

 private:
  kernel_facts facts_ = what_it_is();
};

#if defined CONTCT_FLANG_COMPILER || defined CONTCT_F2C_COMPILER
/// The 8-byte listing by another compiler than gfortran, with the unit 26 of that one's library.
template <fortran::compiled_listing& Listing>
class other_compilers_kernel final : public kernel {
 public:
  static kernel_facts what_it_is() {
    return {Listing.kernel,         8, "listing", "FORTRAN 77", Listing.compiler, Listing.flags, true,
            Listing.text_by_meaning};
  }
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }
  void answer(call<double>& c) override { fortran::contct(c, Listing); }
  std::string take_text() override { return log_.take(); }

 private:
  kernel_facts facts_ = what_it_is();
  fortran::unit_26 log_{Listing};
};
#endif

struct entry {
  const char* name;
  kernel_facts (*facts)();
  std::unique_ptr<kernel> (*make)();
};

template <class Kernel>
constexpr entry known_as(const char* name) {
  return {name, Kernel::what_it_is, []() -> std::unique_ptr<kernel> { return std::make_unique<Kernel>(); }};
}

constexpr entry known_kernels[] = {
    known_as<kernel_r8<fortran_implementation>>("fortran"),
    known_as<kernel_r4<fortran_implementation>>("fortran-r4"),
    known_as<kernel_r8<cpp_implementation>>("cpp"),
    known_as<kernel_r4<cpp_implementation>>("cpp-r4"),
    known_as<corrected_kernel>("corrected"),
#ifdef CONTCT_FLANG_COMPILER
    known_as<other_compilers_kernel<fortran::flang>>("flang"),
#endif
#ifdef CONTCT_F2C_COMPILER
    known_as<other_compilers_kernel<fortran::f2c>>("f2c"),
#endif
};

const entry* entry_of(std::string_view name) {
  for (const entry& e : known_kernels) {
    if (name == e.name) return &e;
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<kernel> make_built_in(std::string_view name) {
  const entry* const known = entry_of(name);
  return known != nullptr ? known->make() : nullptr;
}

std::optional<kernel_facts> facts_of_built_in(std::string_view name) {
  const entry* const known = entry_of(name);
  if (known == nullptr) return {};
  return known->facts();
}

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const entry& e : known_kernels) names.emplace_back(e.name);
  return names;
}

}  // namespace contct::kernels
