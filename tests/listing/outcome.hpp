// What is seen when a copy of the listing is compiled and put to the battery.
#pragma once

#include <string>
#include <vector>

namespace contct_test {

// The words of errata.toml. "source-only" is `unnoticed` where the checksum refuses the copy.
inline const std::string does_not_compile = "does-not-compile";  // or does not link
inline const std::string aborts_under_bounds_check = "aborts-under-bounds-check";
inline const std::string dies = "dies";  // a signal, no end in sight, or another error of the run time
inline const std::string other_numbers = "other-numbers";
inline const std::string other_text = "other-text";
inline const std::string source_only = "source-only";
inline const std::string unnoticed = "unnoticed";  // never a legal expectation

/// SMIN, an SS or an ISEP after one call; reals as the digits of their bits.
struct answer {
  std::string call;
  std::string field;
  std::string value;

  friend bool operator==(const answer&, const answer&) = default;
};

/// All that one copy did.
struct behaviour {
  bool compiles = false;
  bool ends_well = false;       ///< the battery ran to its end
  bool ends_at_bounds = false;  ///< stopped by -fcheck=bounds
  std::vector<answer> answers;  ///< of the calls that returned
  std::string text;             ///< unit 26
  std::string complaint;        ///< of the compiler or the run time
};

/// How a copy differs from the listing: the first difference there is.
struct outcome {
  std::string what;
  std::string call;   ///< where it stopped, or where the first number differs
  std::string field;  ///< the first number that differs
};

outcome classify(const behaviour& listing, const behaviour& copy);

}  // namespace contct_test
