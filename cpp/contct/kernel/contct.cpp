// Compiles the C++ kernels, one function for each precision, for the whole program.
#include "contct/kernel/contct.hpp"

namespace contct {

template int contct(call<float>& c, std::span<event> events) noexcept;
template int contct(call<double>& c, std::span<event> events) noexcept;

}  // namespace contct
