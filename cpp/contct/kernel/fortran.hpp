// The 1989 code, called through ISO_C_BINDING (fortran/contct_c.f90), and its unit 26.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include "contct/kernel/call.hpp"
#include "contct/kernel/contct.h"

namespace contct::fortran {

// The procedures of fortran/contct_c.f90 and fortran/f2c_calls.c.
using call_r8 = decltype(contct_call_r8);
using log_open = decltype(contct_log_open);
using log_act = decltype(contct_log_close);

/// A compiler's build of the 8-byte listing, and the unit 26 of its run-time library.
struct compiled_listing {
  const char* kernel = "";
  const char* compiler = "";
  const char* flags = "";
  bool text_by_meaning = false;  ///< the run-time library may write .25 for 0.25
  call_r8* call = nullptr;
  struct {
    log_open* open = nullptr;
    log_act *flush = nullptr, *rewind = nullptr, *close = nullptr;
    bool is_open = false;
  } log;  ///< unit 26
};

extern compiled_listing gfortran;
extern compiled_listing flang, f2c;  // defined if CMake found these compilers

/// The lock for COMMON /DOF/ and unit 26. Other code that is compiled from the listing must hold this lock
/// too.
[[nodiscard]] std::mutex& process_wide();

/// One call of the listing: built as printed for float, by gfortran only; with 8-byte REAL for double. A lock
/// serialises calls, because COMMON /DOF/ and unit 26 belong to the whole process. The unit-26 text goes to
/// the open unit_26 object of this build; without an open object, the text is lost.
void contct(call<float>& c, const compiled_listing& by = gfortran);
void contct(call<double>& c, const compiled_listing& by = gfortran);

/// In a child process: connects gfortran's unit 26 to the null device, instead of the parent's file.
void forget_unit_26();

/// Collects the listing's text on unit 26 in a file. The constructor throws std::logic_error if another
/// object of the same run-time library exists. The file is unlinked at once, so that it vanishes with the
/// process.
class unit_26 {
 public:
  explicit unit_26(compiled_listing& of = gfortran);
  ~unit_26();
  unit_26(const unit_26&) = delete;
  unit_26& operator=(const unit_26&) = delete;

  /// Returns the text written since the last call of take.
  [[nodiscard]] std::string take();

 private:
  // The size at which `take` empties the file [bytes]. Emptying the file after each call would take several
  // times as long as reading it.
  static constexpr std::size_t enough_text = 1 << 20;

  void begin_anew();

  compiled_listing& listing_;
  int file_ = -1;
  std::size_t taken_ = 0;  // number of bytes of the file that `take` has returned
};

}  // namespace contct::fortran
