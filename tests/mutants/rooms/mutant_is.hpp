// Put into every source of a mutated copy of the tree: which mutant is chosen, and which of them a test
// reaches.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace contct_mutants {

constexpr int most = 65536;

struct choice {
  int number = 0;                    ///< 0: no mutant, the program as it is
  unsigned char* reached = nullptr;  ///< [most], a file that all processes of a test share
};

inline choice read_choice() noexcept {
  choice c;
  if (const char* number = std::getenv("CONTCT_MUTANT")) c.number = std::atoi(number);
  if (const char* path = std::getenv("CONTCT_MUTANTS_REACHED")) {
    const int file = open(path, O_RDWR | O_CLOEXEC);
    if (file >= 0) {
      void* shared = mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
      if (shared != MAP_FAILED) c.reached = static_cast<unsigned char*>(shared);
      close(file);
    }
  }
  return c;
}

inline const choice chosen = read_choice();

}  // namespace contct_mutants

inline bool contct_mutant_is(int number) noexcept {
  if (contct_mutants::chosen.reached != nullptr) contct_mutants::chosen.reached[number] = 1;
  return contct_mutants::chosen.number == number;
}
