// Reads JSON into a tree of toml++ nodes, so that toml_value can report errors with line and column.
#pragma once

#include "contct/read/toml_reader.hpp"

namespace contct {

struct json_tree {
  toml::table table;
  toml_places places;
};

/// Parses a JSON document, which must be one object. Throws input_error with line and column if the text is
/// not JSON, contains null, repeats a key in an object, or is nested more than 16 deep.
[[nodiscard]] json_tree parse_json(std::string_view text, std::string_view file);

}  // namespace contct
