// The only compiled C++ kernels, one for each precision.
#include "contct/kernel/contct.hpp"

namespace contct {

template int contct(call<float>& c, std::span<event> events) noexcept;
template int contct(call<double>& c, std::span<event> events) noexcept;

}  // namespace contct
