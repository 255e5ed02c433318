#include <dlfcn.h>

#include <cstddef>
#include <filesystem>
#include <new>
#include <system_error>

#include "contct/linear/cholesky.hpp"
#include "contct/linear/fortran_names.h"  // CONTCT_FC_GLOBAL(name, NAME), made by CMake

extern "C" {
// Declared as in cholesky.cpp, because release builds compile both files together.
void CONTCT_FC_GLOBAL(dpbtrf, DPBTRF)(const char* uplo, const int* n, const int* kd, double* ab,
                                      const int* ldab, int* info, std::size_t uplo_length);
void CONTCT_FC_GLOBAL(ilaver, ILAVER)(int* major, int* minor, int* patch);
}

namespace contct {
namespace {

/// The file name of the library that contains dpbtrf; empty if it is not found. Throws std::bad_alloc.
std::string library_of_dpbtrf() {
  Dl_info found{};
  // NOLINTNEXTLINE(*-reinterpret-cast): dladdr and dlsym have untyped addresses
  if (dladdr(reinterpret_cast<void*>(&CONTCT_FC_GLOBAL(dpbtrf, DPBTRF)), &found) == 0) return "";
  std::error_code wrong;
  const std::filesystem::path real = std::filesystem::canonical(found.dli_fname, wrong);
  if (wrong == std::errc::not_enough_memory)
    throw std::bad_alloc();  // otherwise the link's name would be returned
  return (wrong ? std::filesystem::path(found.dli_fname) : real).filename().string();
}

/// The configuration and core type of OpenBLAS; empty if OpenBLAS is not loaded.
std::string openblas_identity() {
  using configuration = char*();
  // NOLINTNEXTLINE(*-reinterpret-cast)
  const auto get_config = reinterpret_cast<configuration*>(dlsym(RTLD_DEFAULT, "openblas_get_config"));
  return get_config == nullptr ? "" : get_config();
}

}  // namespace

std::string lapack_identity() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  CONTCT_FC_GLOBAL(ilaver, ILAVER)(&major, &minor, &patch);
  std::string words = "LAPACK " + std::to_string(major);
  words += "." + std::to_string(minor) + "." + std::to_string(patch);
  for (const std::string& more : {library_of_dpbtrf(), openblas_identity()})
    if (!more.empty()) words += ", " + more;
  return words;
}

}  // namespace contct
