// Compiles C++ CONTCT for float and double, once for the whole program.
#include "contct/kernel/contct.hpp"

namespace contct {

template int contct(call<float>& c, std::span<event> events) noexcept;
template int contct(call<double>& c, std::span<event> events) noexcept;

}  // namespace contct
