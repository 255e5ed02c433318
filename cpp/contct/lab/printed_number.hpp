// A number as it is printed, beside the exact one: rounded to its digits, or cut after them.
#pragma once

#include <string_view>

#include "contct/numeric/rational.hpp"

namespace contct::lab {

/// How a printed number stands to the exact one.
enum class printing {
  rounded,  ///< the nearest one of so many digits
  cut,      ///< the exact one without its further digits, and not the nearest
  neither,
};

/// The number that `words` write: "p/q", or a decimal as "-12", "0.125" or "-1.25e-07". Throws
/// std::invalid_argument where they write none.
[[nodiscard]] rational number_printed(std::string_view words);

/// `printed` is a decimal. 0 agrees with 0 alone. Throws std::invalid_argument where it is none.
[[nodiscard]] printing printing_of(std::string_view printed, const rational& exact);

}  // namespace contct::lab
