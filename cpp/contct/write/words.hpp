// The words for statuses and events, the same on the terminal, on the page and in every file.
#pragma once

#include <string_view>

#include "contct/kernel/call.hpp"
#include "contct/path/frames.hpp"
#include "contct/path/path.hpp"

namespace contct::write {

/// "below" or "above".
constexpr std::string_view surface_name(int surface) {
  return surface == face_above ? "above" : "below";
}

/// "make" or "break".
constexpr std::string_view change_name(change c) {
  return c == change::make ? "make" : "break";
}

/// "contact" or "separated".
constexpr std::string_view state_name(int isep) {
  return isep == in_contact ? "contact" : "separated";
}

/// "open", "closed" or "at its face".
constexpr std::string_view look_name(pair_look look) {
  switch (look) {
    case pair_look::open:
      return "open";
    case pair_look::closed:
      return "closed";
    case pair_look::at_face:
      return "at its face";
  }
  return "";
}

/// "solved", "mechanism" or "iteration-limit".
constexpr std::string_view status_name(path_status status) {
  switch (status) {
    case path_status::solved:
      return "solved";
    case path_status::mechanism:
      return "mechanism";
    default:
      return "iteration-limit";
  }
}

/// Why a path ended where it did: "all load applied", "mechanism", "cycle", ...
constexpr std::string_view end_reason(path_status status) {
  switch (status) {
    case path_status::solved:
      return "all load applied";
    case path_status::mechanism:
      return "mechanism";
    case path_status::cycle:
      return "cycle";
    case path_status::iteration_limit:
      return "iteration limit";
    case path_status::not_factored:
      return "not factored";
  }
  return "";
}

}  // namespace contct::write
