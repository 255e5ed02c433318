// Compares a part of JSON with what a test expects of it.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "catch.hpp"

namespace contct {

/// Returns true if `part` meets a condition: "~words" that are in it, or "> 3", "== 3" .. for
/// a number or for the size of anything else.
inline bool meets(const nlohmann::json& part, const std::string& condition) {
  if (condition.starts_with("~")) return part.dump().find(condition.substr(1)) != std::string::npos;
  const std::size_t sign = condition.find_first_of("<>=");
  if (sign == std::string::npos || part.is_null()) return false;
  const std::size_t size = part.is_string() ? part.get<std::string>().size() : part.size();
  const double x = part.is_number() ? part.get<double>() : static_cast<double>(size);
  const bool or_equal = condition[sign + 1] == '=';
  const double limit = std::stod(condition.substr(sign + (or_equal ? 2 : 1)));
  return (or_equal && x == limit) || (condition[sign] == '<' && x < limit) ||
         (condition[sign] == '>' && x > limit);
}

/// Returns a line for each value in `part` that is not as expected. Objects and arrays may have more values
/// than an object `expected`, which has keys or indices. A number with a fraction may differ by this share. A
/// text can be a condition, or "absent".
inline std::string unlike(const nlohmann::json& part, const nlohmann::json& expected, double share,
                          const std::string& at) {
  const bool same_size = expected.is_array() && part.is_array() && expected.size() == part.size();
  if (same_size || (expected.is_object() && part.is_structured())) {
    std::string all;
    for (const auto& [key, value] : expected.items()) {
      const bool there = part.is_array() ? std::stoul(key) < part.size() : part.contains(key);
      if (there == (value == "absent"))
        all += at + key + (there ? ": found" : ": missing") + "; expected: " + value.dump() + "\n";
      else if (there)
        all += unlike(part.is_array() ? part[std::stoul(key)] : part[key], value, share, at + key + "/");
    }
    return all;
  }
  if (part == expected || (expected.is_string() && meets(part, expected))) return "";
  if (expected.is_number_float() && part.is_number() &&
      std::abs(part.get<double>() - expected.get<double>()) <= share * std::abs(expected.get<double>()))
    return "";
  return at + ": found " + part.dump().substr(0, 200) + "; expected: " + expected.dump() + "\n";
}

/// Checks that `part` is as expected, see `unlike`. A text of JSON is parsed, and may have comments.
inline void check_like(const nlohmann::json& part, const nlohmann::json& expected, double share = 1e-9) {
  const bool is_text = expected.is_string() && expected.get<std::string>().find_first_of("[{") == 0;
  const auto value =
      is_text ? nlohmann::json::parse(expected.get<std::string>(), nullptr, true, true) : expected;
  INFO("expected: " << value.dump());
  const std::string differences = unlike(part, value, share, "/");
  INFO(differences);
  CHECK(differences.empty());
}

}  // namespace contct
