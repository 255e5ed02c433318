// Random numbers that are the same on every platform, unlike those of standard distributions.
#pragma once

#include <cstdint>

namespace contct {

/// Sebastiano Vigna's generator splitmix64.
class random_numbers {
 public:
  explicit constexpr random_numbers(std::uint64_t seed) : state_(seed) {}

  constexpr std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  /// A whole number from `least` to `most`, both included. The bias is below 2^-32.
  constexpr int whole(int least, int most) {
    const auto choices = static_cast<std::uint64_t>(most - least) + 1;
    return least + static_cast<int>((bits() >> 32) % choices);
  }

  /// A multiple of 2^-53, at least 0 and less than 1.
  constexpr double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  constexpr bool chance(double p) { return unit() < p; }

 private:
  std::uint64_t state_;
};

}  // namespace contct
