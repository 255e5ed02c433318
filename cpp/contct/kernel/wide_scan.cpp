#include "contct/kernel/wide_scan.hpp"

#include <array>
#include <cstdint>
#include <limits>

#include "contct/kernel/contct.hpp"

namespace contct::kernels {
namespace {

/// A function that becomes part of another.
#define CONTCT_PART CONTCT_TARGET __attribute__((always_inline)) inline

// What any processor has; on aarch64 that is NEON. None of the sets is named together with FMA, and without
// contraction none of them is used for one.
namespace two_lanes {
#define CONTCT_LANES 2
#define CONTCT_TARGET
#include "contct/kernel/wide_scan_body.hpp"
#undef CONTCT_LANES
#undef CONTCT_TARGET
}  // namespace two_lanes

#ifdef __x86_64__
namespace avx2 {
#define CONTCT_LANES 4
#define CONTCT_TARGET __attribute__((target("avx2")))
#include "contct/kernel/wide_scan_body.hpp"
#undef CONTCT_LANES
#undef CONTCT_TARGET
}  // namespace avx2

namespace avx512 {
#define CONTCT_LANES 8
#define CONTCT_TARGET __attribute__((target("avx512f,avx512vl,avx512dq")))
#include "contct/kernel/wide_scan_body.hpp"
#undef CONTCT_LANES
#undef CONTCT_TARGET
}  // namespace avx512
#endif

#define CONTCT_SCAN(name, many_pairs, set)                                                        \
  wide_scan {                                                                                     \
    name, set::lanes, many_pairs, set::counts_up, set::listing, set::near, set::largest_response, \
        set::corrected                                                                            \
  }

/// All that are built in, narrowest first.
constexpr std::array all_scans = {
#ifdef __x86_64__
    CONTCT_SCAN("SSE2", 10'000, two_lanes),
    CONTCT_SCAN("AVX2", 32, avx2),
    CONTCT_SCAN("AVX-512", 32, avx512),
#elif defined(__aarch64__)
    CONTCT_SCAN("NEON", 32, two_lanes),
#else
    CONTCT_SCAN("two lanes", 10'000, two_lanes),
#endif
};

/// How many of them this processor, and its system, can run.
std::size_t scans_here() {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2")) return 1;
  const bool has_512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                       __builtin_cpu_supports("avx512dq");
  return has_512 ? 3 : 2;
#else
  return all_scans.size();
#endif
}

}  // namespace

std::span<const wide_scan> wide_scans() {
  static const std::size_t here = scans_here();
  return std::span(all_scans).first(here);
}

const wide_scan& widest_scan() {
  static const wide_scan& widest = wide_scans().back();
  return widest;
}

}  // namespace contct::kernels
