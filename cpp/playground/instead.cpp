// A web page has no child processes, no libraries loaded at run time and no files. These functions replace
// them in the playground.
#include <cmath>
#include <stdexcept>

#include "contct/kernel/child_kernel.hpp"
#include "contct/linear/cholesky.hpp"

extern "C" {
void ilaver_(int* major, int* minor, int* patch);

/// The block size for dpbtrf by the number of subdiagonals, as in LAPACK's ilaenv.
int ilaenv_(const int* /*what*/, const char* /*name*/, const char* /*options*/, const int* /*n*/,
            const int* subdiagonals, const int* /*n3*/, const int* /*n4*/, int /*name_length*/,
            int /*options_length*/) {
  return *subdiagonals <= 64 ? 1 : 32;
}

int disnan_(const double* x) {
  return std::isnan(*x) ? 1 : 0;
}

/// The nearest integer; a function of f2c's library.
int i_dnnt(const double* x) {
  return static_cast<int>(std::lround(*x));
}

/// LAPACK calls xerbla only for invalid arguments, which do not occur.
void xerbla_(const char* /*name*/, const int* /*argument*/, int /*length*/) {
  __builtin_trap();
}

/// Throws std::logic_error: only the rigid-body motions of a matrix need eigenvalues, and a page has no
/// matrix files.
void dsyev_(const char* /*jobz*/, const char* /*uplo*/, const int* /*n*/, double* /*a*/, const int* /*lda*/,
            double* /*w*/, double* /*work*/, const int* /*lwork*/, int* /*info*/, std::size_t /*jobz_length*/,
            std::size_t /*uplo_length*/) {
  throw std::logic_error("dsyev: found a matrix; allowed in a page: beams and plates");
}
}

namespace contct {

std::string lapack_identity() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  ilaver_(&major, &minor, &patch);
  return "LAPACK " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch) +
         ", by f2c";
}

std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& /*limits*/) {
  throw std::invalid_argument("plugin:" + path + ": found a library; allowed in a page: built-in kernels");
}

std::unique_ptr<kernel> make_pipe(const std::string& command, const outside_limits& /*limits*/) {
  throw std::invalid_argument("pipe:" + command + ": found a command; allowed in a page: built-in kernels");
}

}  // namespace contct
