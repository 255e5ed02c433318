// The listing's text on unit 26, written from events as data.
#pragma once

#include <span>
#include <string>

#include "contct/kernel/call.hpp"

namespace contct {

/// Append the unit-26 text of one finished call: its FORMATs 20, or 40, 50 and 60, byte for byte
/// as gfortran writes them. `c` holds the outputs of the call, `events` what it returned.
/// Precondition: 0 < c.smin <= 1, which the listing guarantees.
template <class Real>
void append_log_text(const call<Real>& c, std::span<const event> events, std::string& text);

extern template void append_log_text(const call<float>&, std::span<const event>, std::string&);
extern template void append_log_text(const call<double>&, std::span<const event>, std::string&);

}  // namespace contct
