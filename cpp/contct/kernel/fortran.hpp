// The 1989 code itself, called through ISO_C_BINDING (fortran/contct_c.f90), and its unit 26.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include "contct/kernel/call.hpp"

namespace contct::fortran {

// The procedures of fortran/contct_c.f90 and fortran/f2c_calls.c.
using call_r8 = void(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                     const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);
using log_open = int(const char* path, int length);
using log_act = void();

/// A compiler's build of the 8-byte listing, and the unit 26 of its run-time library.
struct compiled_listing {
  const char* kernel = "";       ///< name of the kernel
  const char* compiler = "";     ///< for people
  const char* flags = "";        ///< for people
  bool text_by_meaning = false;  ///< its run-time library may write .25 for 0.25
  call_r8* call = nullptr;
  struct {
    log_open* open = nullptr;
    log_act *flush = nullptr, *rewind = nullptr, *close = nullptr;
    bool is_open = false;
  } log;  ///< unit 26
};

extern compiled_listing gfortran;
extern compiled_listing flang, f2c;  // where CMake found them

/// Serialises everything that touches COMMON /DOF/ or unit 26; whatever else is compiled from the
/// listing must hold it too.
[[nodiscard]] std::mutex& process_wide();

/// One call of the listing: built as printed for float, with 8-byte REAL for double.
/// COMMON /DOF/ and unit 26 belong to the whole process, so calls are serialised by a lock.
/// The text goes to the unit_26 object of that kernel that is open, or nowhere.
void contct(call<float>& c);
void contct(call<double>& c, const compiled_listing& by = gfortran);

/// In a child process: let go of the parent's unit 26 of gfortran, which leads to the null device from now
/// on.
void forget_unit_26();

/// Unit 26 while this object lives: the listing's text is kept and returned. One at a time for each run-time
/// library of a process: a second one throws std::logic_error. The file behind it is unlinked at once, so
/// nothing is left behind however the process ends.
class unit_26 {
 public:
  explicit unit_26(compiled_listing& of = gfortran);
  ~unit_26();
  unit_26(const unit_26&) = delete;
  unit_26& operator=(const unit_26&) = delete;

  /// All text written since the last take, and forget it.
  [[nodiscard]] std::string take();

 private:
  // A path takes each call's text by one read of the new part. Emptying the file takes several times as long.
  static constexpr std::size_t enough_text = 1 << 20;  // then the file is emptied

  void begin_anew();

  compiled_listing& listing_;
  int file_ = -1;
  std::size_t taken_ = 0;  // of the file, from its beginning
};

}  // namespace contct::fortran
