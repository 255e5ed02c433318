// The 8-byte listing as each compiler built it, called from C++.
#pragma once

#include "contct/rooms.hpp"

namespace contct::kernels::fortran {

// The procedures of fortran/contct_c.f90 and fortran/f2c_calls.c.
using call_r8 = void(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                     const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);
using log_open = int(const char* path, int length);
using log_act = void();

/// A compiler's build of the listing, and the unit 26 of its run-time library.
struct compiled_listing {
  const char* kernel;    ///< name of the kernel
  const char* compiler;  ///< for people
  const char* flags;     ///< for people
  bool text_by_meaning;  ///< its run-time library may write .25 for 0.25
  call_r8* call;
  log_open* open;
  log_act* flush;
  log_act* rewind;
  log_act* close;
  bool unit_26_is_open;
};

extern compiled_listing gfortran;
extern compiled_listing flang, f2c;  // where CMake found them

}  // namespace contct::kernels::fortran
