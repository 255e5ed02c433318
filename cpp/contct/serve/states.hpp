// The states of a path, as a picture that is redrawn all the time needs them: less than the report's.
#pragma once

#include <string>

#include "contct/write/finished_run.hpp"

namespace contct::serve {

/// JSON: { "kind", "kernels", "comparison", "ended", "certified": [words], "certified_whole", "increments",
/// "x": [places along a beam], "supports": [{ "x", "dofs" }], "pairs": [{ "pair", "x", "face", "side" }],
/// "frames": [{ "step", "number", "fraction", "end", "load": words, "largest": the largest deflection,
/// "events": [{ "pair", "change" }], "looks": "ocf" a pair, "w": [at these places] }] }. Only a beam has
/// places, and at most a few hundred.
[[nodiscard]] std::string states_json(const finished_run& r);

}  // namespace contct::serve
