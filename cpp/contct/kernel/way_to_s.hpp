// The four ways in which the listing's DO 10 loop gives a pair its s.
#pragma once

namespace contct::kernels {

/// Which branch of the DO 10 loop gave a pair its s.
enum class way_to_s {
  no_response,       ///< d* = 0: s is 1, the mark for "no event"
  stationary,        ///< at its face, and the load keeps it as it is: s is 1, the same mark
  stationary_event,  ///< at its face, and the load changes it: eq. 12
  moving,            ///< advancing or receding: eq. 4
};

}  // namespace contct::kernels
