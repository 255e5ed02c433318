// The reader of reference/verification.toml, and of the numbers in it.
#include <sys/mman.h>
#include <unistd.h>

#include "contct/lab/verify.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contct::fuzz;
  using namespace contct::lab;
  static const int file = memfd_create("verification", 0);
  require(ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == static_cast<ssize_t>(size),
          "memory is written");
  std::vector<verification_case> cases;
  if (!is_read([&] { cases = read_verification("/proc/self/fd/" + std::to_string(file)); })) return 0;
  for (const verification_case& c : cases)
    for (const expected_number& e : c.checks) {
      require(!quantity_words(e).empty(), "a number has a name", c.file);
      (void)exact_disagreement(e, e.value, e.tolerance);
    }
  return 0;
}
