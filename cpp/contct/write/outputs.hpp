// The files of a run that is over.
#pragma once

#include "contct/session/run.hpp"

namespace contct {

/// Complete and name them.
void write_outputs(const run& r);

}  // namespace contct
