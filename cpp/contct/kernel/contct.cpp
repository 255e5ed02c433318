// The C++ kernels as machine code: one function for each precision, called by everything that calls CONTCT in
// C++.
#include "contct/kernel/contct.hpp"

namespace contct {

template int contct(call<float>& c, std::span<event> events) noexcept;
template int contct(call<double>& c, std::span<event> events) noexcept;

}  // namespace contct
