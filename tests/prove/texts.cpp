// contct_texts STEP: compares the texts of gfortran's FORMAT and of C++ for every STEP-th 4-byte SMIN below
// 1. The prover shows that SMIN is above 0 and at most 1; only FORMAT 20 writes the value 1.
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "contct/kernel/log_text.hpp"

namespace {

using contct::change;
using contct::event;

constexpr std::size_t batch = 4096;
constexpr std::size_t width = 11;
using lines = std::array<char, batch * width>;

extern "C" void texts_(const float* smin, const int* n, char* texts, std::size_t length);

/// Returns the number of values with different texts.
int differences(std::span<const float> values) {
  static lines by_fortran;
  const int n = static_cast<int>(values.size());
  texts_(values.data(), &n, by_fortran.data(), width);
  int id = 1;
  int isurf = 1;
  contct::call<float> c{};
  c.id = {&id, 1};
  c.isurf = {&isurf, 1};
  const event made{0, change::make};
  int different = 0;
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k) {
    c.smin = values[k];
    text.clear();
    append_log_text(c, std::span<const event>(&made, 1), text);
    const std::string ours = text.substr(text.size() - width - 1, width);  // the last characters of the line
    if (ours.compare(0, width, &by_fortran[k * width], width) == 0) continue;
    if (++different == 1)
      std::printf("%a: %s in C++, %.11s by FORTRAN\n", values[k], ours.c_str(), &by_fortran[k * width]);
  }
  return different;
}

}  // namespace

int main(int count, char** words) {
  const std::uint64_t step = count > 1 ? std::strtoul(words[1], nullptr, 10) : 1;
  const std::uint64_t last = std::bit_cast<std::uint32_t>(1.0F) - 1;
  std::uint64_t compared = 0;
  int different = 0;
  static std::array<float, batch> values;
  for (std::uint64_t bits = 1; bits <= last;) {
    std::size_t n = 0;
    for (; n < batch && bits <= last; bits += step)
      values[n++] = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    different += differences(std::span(values).first(n));
    compared += n;
  }
  std::printf("%llu values of SMIN compared, %d texts differ\n", static_cast<unsigned long long>(compared),
              different);
  return different == 0 && compared > 0 ? 0 : 1;
}
