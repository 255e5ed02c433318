// The listing by another compiler, against gfortran's and the C++ kernel, on random calls.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "contct/compare/compare.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "support/one_pair.hpp"

namespace contct {

/// What came of putting calls to the kernel `name`, to "fortran" and to "cpp".
struct three_compared {
  tally answers, text;
  std::int64_t lines = 0;            ///< of the kernel's text
  std::int64_t different_bytes = 0;  ///< calls whose text is not gfortran's byte for byte
};

inline three_compared compare_three(const std::string& name, int calls) {
  const auto asked = make_kernel(name);
  const auto gfortran = make_kernel("fortran");
  const auto cpp = make_kernel("cpp");
  random_calls<double> source(1989);
  three_compared result;
  for (int i = 0; i < calls; ++i) {
    const call_inputs<double>& in = source.random(i);
    const call_outputs a = answer_of(*asked, in);
    for (kernel* other : {gfortran.get(), cpp.get()}) {
      const call_outputs b = answer_of(*other, in);
      (void)compare_answers<double>({b.smin, b.ss, b.isep}, {a.smin, a.ss, a.isep}, result.answers);
      (void)compare_text(b.text, a.text, result.text, text_equality_of(other->facts(), asked->facts()));
      if (a.text != b.text) ++result.different_bytes;
    }
    result.lines += std::count(a.text.begin(), a.text.end(), '\n');
  }
  return result;
}

/// One pair with a gap of 1 whose scale factor is `s`.
inline call_inputs<double> one_pair_at(double s) {
  return {{0.0}, {1.0 / s}, {1.0}, {1}, {separated}, {face_above}, {}};
}

}  // namespace contct
