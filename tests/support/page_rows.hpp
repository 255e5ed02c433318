// What stands in a table of a page's data.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The rows of the first table whose title begins so.
inline nlohmann::json rows_of(const nlohmann::json& tables, const std::string& title) {
  for (const auto& t : tables)
    if (t["title"].get<std::string>().starts_with(title)) return t["rows"];
  return nullptr;
}
