// The listing's text on unit 26, made from events.
#pragma once

#include <span>
#include <string>

#include "contct/kernel/call.hpp"

namespace contct {

/// Appends the unit-26 text of a finished call, byte for byte as gfortran writes it: FORMAT 20, or FORMATs
/// 40, 50 and 60 for each event. `c` contains the outputs of the call. Precondition: 0 < c.smin <= 1, as
/// always in the listing.
template <class Real>
void append_log_text(const call<Real>& c, std::span<const event> events, std::string& text);

extern template void append_log_text(const call<float>&, std::span<const event>, std::string&);
extern template void append_log_text(const call<double>&, std::span<const event>, std::string&);

}  // namespace contct
