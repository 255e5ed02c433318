#include "contct/kernel/compiled_listing.hpp"

using contct::kernels::fortran::call_r8;
using contct::kernels::fortran::log_act;
using contct::kernels::fortran::log_open;

extern "C" {
call_r8 contct_call_r8, contct_flang_call_r8, contct_f2c_call_r8;
log_open contct_log_open, contct_flang_log_open, contct_f2c_log_open;
log_act contct_log_flush, contct_flang_log_flush, contct_f2c_log_flush;
log_act contct_log_rewind, contct_flang_log_rewind, contct_f2c_log_rewind;
log_act contct_log_close, contct_flang_log_close, contct_f2c_log_close;
}

namespace contct::kernels::fortran {

// The compilers' names are set by CMake.
compiled_listing gfortran{.kernel = "fortran",
                          .compiler = CONTCT_FORTRAN_COMPILER,
                          .flags = CONTCT_FORTRAN_FLAGS " -fdefault-real-8",
                          .text_by_meaning = false,
                          .call = contct_call_r8,
                          .open = contct_log_open,
                          .flush = contct_log_flush,
                          .rewind = contct_log_rewind,
                          .close = contct_log_close,
                          .unit_26_is_open = false};
#ifdef CONTCT_FLANG_COMPILER
compiled_listing flang{.kernel = "flang",
                       .compiler = CONTCT_FLANG_COMPILER,
                       .flags = "-O2 -fdefault-real-8 -ffp-contract=off",
                       .text_by_meaning = false,
                       .call = contct_flang_call_r8,
                       .open = contct_flang_log_open,
                       .flush = contct_flang_log_flush,
                       .rewind = contct_flang_log_rewind,
                       .close = contct_flang_log_close,
                       .unit_26_is_open = false};
#endif
#ifdef CONTCT_F2C_COMPILER
compiled_listing f2c{.kernel = "f2c",
                     .compiler = CONTCT_F2C_COMPILER,
                     .flags = "-r8; -ffp-contract=off",
                     .text_by_meaning = true,
                     .call = contct_f2c_call_r8,
                     .open = contct_f2c_log_open,
                     .flush = contct_f2c_log_flush,
                     .rewind = contct_f2c_log_rewind,
                     .close = contct_f2c_log_close,
                     .unit_26_is_open = false};
#endif

}  // namespace contct::kernels::fortran
