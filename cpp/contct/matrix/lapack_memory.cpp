#include "contct/matrix/lapack_memory.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace contct::matrix {
namespace {

/// A function of OpenBLAS; null where that is not loaded.
template <class Function>
Function* of_openblas(const char* name) {
  // NOLINTNEXTLINE(*-reinterpret-cast): dlsym has untyped addresses
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Is there room for so many at once? Throws std::bad_alloc where there is none.
void find_room_for(int buffers) {
  constexpr std::size_t size = (std::size_t{128} << 20U) + (std::size_t{1} << 16U);
  std::vector<std::unique_ptr<std::byte[]>> all(static_cast<std::size_t>(buffers));
  for (auto& room : all) room = std::make_unique_for_overwrite<std::byte[]>(size);
}

}  // namespace

void take_lapack_memory(bool of_every_thread) {
  auto* const threads = of_openblas<int()>("openblas_get_num_threads");
  auto* const take = of_openblas<void*(int)>("blas_memory_alloc");
  auto* const give_back = of_openblas<void(void*)>("blas_memory_free");
  if (threads == nullptr || take == nullptr || give_back == nullptr) return;
  const int count = of_every_thread ? threads() : 1;
  find_room_for(count);
  std::vector<void*> buffers(static_cast<std::size_t>(count));
  for (void*& buffer : buffers) buffer = take(0);
  for (void* const buffer : buffers) give_back(buffer);
}

}  // namespace contct::matrix
