// The listing by another compiler, against gfortran's and the C++ kernel, on random calls.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/outside/registry.hpp"

/// One kernel's answers: what is compared of one call.
struct kernel_answer {
  double smin = contct::app::not_an_answer;
  std::vector<double> ss;
  std::vector<int> isep;
  std::string text;
};

inline kernel_answer ask_kernel(contct::app::kernel& k, const contct::app::call_inputs<double>& in) {
  kernel_answer a{
      contct::app::not_an_answer, std::vector<double>(in.cc.size(), contct::app::not_an_answer), in.isep, {}};
  contct::app::call<double> c{in.dd, in.dtest, in.cc, a.ss, a.smin, in.id, a.isep, in.isurf, in.dof};
  k.answer(c);
  a.smin = c.smin;
  a.text = k.take_text();
  return a;
}

/// What came of putting calls to the kernel `name`, to "fortran" and to "cpp".
struct three_compared {
  contct::app::tally answers, text;
  std::int64_t lines = 0;            ///< of the kernel's text
  std::int64_t different_bytes = 0;  ///< calls whose text is not gfortran's byte for byte
};

inline three_compared compare_three(const std::string& name, int calls) {
  using namespace contct::app;
  const auto asked = make_kernel(name);
  const auto gfortran = make_kernel("fortran");
  const auto cpp = make_kernel("cpp");
  random_calls<double> source(1989);
  three_compared result;
  for (int i = 0; i < calls; ++i) {
    const call_inputs<double>& in = source.random(i);
    const kernel_answer a = ask_kernel(*asked, in);
    for (kernel* other : {gfortran.get(), cpp.get()}) {
      const kernel_answer b = ask_kernel(*other, in);
      (void)compare_answers<double>({b.smin, b.ss, b.isep}, {a.smin, a.ss, a.isep}, result.answers);
      (void)compare_text(b.text, a.text, result.text, text_equality_of(other->facts(), asked->facts()));
      if (a.text != b.text) ++result.different_bytes;
    }
    result.lines += std::count(a.text.begin(), a.text.end(), '\n');
  }
  return result;
}

/// One pair with a gap of 1 whose scale factor is `s`.
inline contct::app::call_inputs<double> one_pair_at(double s) {
  return {{0.0}, {1.0 / s}, {1.0}, {1}, {contct::app::separated}, {contct::app::face_above}, {}};
}
