// JSON as the tree that TOML is read into, so that toml_value reports errors in either with their places.
#pragma once

#include "contct/read/toml_reader.hpp"

namespace contct {

struct json_tree {
  toml::table table;
  toml_places places;
};

/// Parse a whole document, an object. Throws input_error with line and column for text that is not JSON, a
/// null, a key that an object has twice, and values that are more than 16 deep.
[[nodiscard]] json_tree parse_json(std::string_view text, std::string_view file);

}  // namespace contct
