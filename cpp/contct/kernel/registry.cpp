#include "contct/kernel/registry.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "contct/kernel/child_kernel.hpp"
#include "contct/kernel/contct.hpp"
#include "contct/kernel/fortran.hpp"
#include "contct/kernel/log_text.hpp"
#include "contct/text/strings.hpp"

namespace contct {

extern template int contct(call<float>& c, std::span<event> events) noexcept;  // in contct.cpp
extern template int contct(call<double>& c, std::span<event> events) noexcept;

namespace {

const char* const cxx_compiler = CONTCT_CXX_COMPILER;    // NOLINT: set by CMake
const char* const cxx_flags = CONTCT_CXX_FLAGS;          // NOLINT: set by CMake
const char* const fortran_flags = CONTCT_FORTRAN_FLAGS;  // NOLINT: set by CMake

/// Answers `c` with `answer`, which takes the call in REAL of `real_bytes`.
template <class Answer>
void answer_in(int real_bytes, call<double>& c, Answer answer) {
  in_precision(c, real_bytes, [&](auto& own) {
    answer(own);
    if constexpr (sizeof own.smin == 4) {
      std::copy(own.ss.begin(), own.ss.end(), c.ss.begin());
      c.smin = own.smin;
    }
  });
}

/// C++ CONTCT in REAL of `real_bytes`.
function_kernel::function cpp_contct(int real_bytes) {
  return [real_bytes, events = std::vector<event>()](call<double>& c, std::string& text) mutable {
    answer_in(real_bytes, c, [&](auto& own) {
      if (events.size() < own.cc.size()) events.resize(own.cc.size());
      const int happened = contct(own, std::span<event>(events));
      append_log_text(own, std::span<const event>(events.data(), happened), text);
    });
  };
}

/// The 1989 code as one compiler builds it. Each object occupies unit 26 of the compiler's run-time library.
class fortran_kernel final : public kernel {
 public:
  fortran_kernel(const kernel_facts& facts, fortran::compiled_listing& by)
      : kernel(facts), listing_(by), log_(by) {}
  void answer(call<double>& c) override {
    answer_in(facts().real_bytes, c, [this](auto& own) { fortran::contct(own, listing_); });
  }
  std::string take_text() override { return log_.take(); }

 private:
  const fortran::compiled_listing& listing_;
  fortran::unit_26 log_;
};

struct entry {
  kernel_facts facts;
  std::function<std::unique_ptr<kernel>(const kernel_facts&)> make;
};

entry compiled_by(fortran::compiled_listing& by) {
  return {
      {by.kernel, 8, contact_rule::listing, "FORTRAN 77", by.compiler, by.flags, true, by.text_by_meaning},
      [&by](const kernel_facts& f) { return std::make_unique<fortran_kernel>(f, by); }};
}

entry as_printed() {
  entry e = compiled_by(fortran::gfortran);
  e.facts.name = "fortran-r4";
  e.facts.real_bytes = 4;
  e.facts.flags = fortran_flags;
  return e;
}

entry in_cpp(const char* name, int real_bytes, contact_rule rule, const function_kernel::function& answer) {
  const bool has_text = rule == contact_rule::listing;
  return {{name, real_bytes, rule, "C++20", cxx_compiler, cxx_flags, has_text},
          [answer](const kernel_facts& f) { return std::make_unique<function_kernel>(f, answer); }};
}

const std::vector<entry>& known_kernels() {
  static const std::vector<entry> known = {
      compiled_by(fortran::gfortran),
      as_printed(),
      in_cpp("cpp", 8, contact_rule::listing, cpp_contct(8)),
      in_cpp("cpp-r4", 4, contact_rule::listing, cpp_contct(4)),
      in_cpp("corrected", 8, contact_rule::corrected,
             [](call<double>& c, std::string& /*text*/) { contct_corrected(c); }),
#ifdef CONTCT_FLANG_COMPILER
      compiled_by(fortran::flang),
#endif
#ifdef CONTCT_F2C_COMPILER
      compiled_by(fortran::f2c),
#endif
  };
  return known;
}

/// Throws std::invalid_argument, with the known names, if the name is unknown.
const entry& built_in_named(std::string_view name) {
  for (const entry& e : known_kernels())
    if (name == e.facts.name) return e;
  const std::vector<std::string> known = kernel_names();
  throw std::invalid_argument("no kernel is named \"" + std::string(name) + "\"" + did_you_mean(name, known) +
                              "; allowed: " + joined(known, ", ") + ", plugin:LIBRARY, pipe:COMMAND");
}

/// The part of `name` after `prefix`; nothing if `name` does not start with `prefix` or is equal to `prefix`.
std::optional<std::string> after(std::string_view prefix, std::string_view name) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return {};
  return std::string(name.substr(prefix.size()));
}

}  // namespace

std::string kernel::take_text() {
  return std::exchange(text_, {});
}

std::unique_ptr<kernel> make_kernel(std::string_view name) {
  if (const auto path = after("plugin:", name)) return make_plugin(*path);
  if (const auto command = after("pipe:", name)) return make_pipe(*command);
  const entry& e = built_in_named(name);
  return e.make(e.facts);
}

kernel_facts facts_of_kernel(std::string_view name) {
  if (after("plugin:", name)) return facts_of_outside(std::string(name), "a shared library");
  if (after("pipe:", name)) return facts_of_outside(std::string(name), "a command");
  return built_in_named(name).facts;
}

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const entry& e : known_kernels()) names.push_back(e.facts.name);
  return names;
}

}  // namespace contct
