#include "contct/kernel/fortran.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "contct/text/output_file.hpp"

using contct::fortran::call_r8;
using contct::fortran::log_act;
using contct::fortran::log_open;

extern "C" {
call_r8 contct_flang_call_r8, contct_f2c_call_r8;
log_open contct_flang_log_open, contct_f2c_log_open;
log_act contct_flang_log_flush, contct_flang_log_rewind, contct_flang_log_close;
log_act contct_f2c_log_flush, contct_f2c_log_rewind, contct_f2c_log_close;
}

namespace contct::fortran {

compiled_listing gfortran{"fortran",
                          CONTCT_FORTRAN_COMPILER,
                          CONTCT_FORTRAN_FLAGS " -fdefault-real-8",
                          false,
                          contct_call_r8,
                          {contct_log_open, contct_log_flush, contct_log_rewind, contct_log_close}};
#ifdef CONTCT_FLANG_COMPILER
compiled_listing flang{
    "flang",
    CONTCT_FLANG_COMPILER,
    "-O2 -fdefault-real-8 -ffp-contract=off",
    false,
    contct_flang_call_r8,
    {contct_flang_log_open, contct_flang_log_flush, contct_flang_log_rewind, contct_flang_log_close}};
#endif
#ifdef CONTCT_F2C_COMPILER
compiled_listing f2c{
    "f2c",
    CONTCT_F2C_COMPILER,
    "-r8; -ffp-contract=off",
    true,
    contct_f2c_call_r8,
    {contct_f2c_log_open, contct_f2c_log_flush, contct_f2c_log_rewind, contct_f2c_log_close}};
#endif

std::mutex& process_wide() {
  static std::mutex mutex;
  return mutex;
}

namespace {

template <class Real, class Procedure>
void call_alone(call<Real>& c, Procedure* procedure) {
  const std::scoped_lock lock(process_wide());
  procedure(c.dd.data(), c.dtest.data(), c.cc.data(), c.ss.data(), &c.smin, c.id.data(), c.isep.data(),
            c.isurf.data(), c.nc(), c.dof.indof, c.dof.ndofpn);
}

}  // namespace

void contct(call<float>& c, const compiled_listing& /*by*/) {
  call_alone(c, contct_call_r4);
}

void contct(call<double>& c, const compiled_listing& by) {
  call_alone(c, by.call);
}

void forget_unit_26() {
  constexpr std::string_view nowhere = "/dev/null";
  gfortran.log.close();
  (void)gfortran.log.open(nowhere.data(), static_cast<int>(nowhere.size()));
}

unit_26::unit_26(compiled_listing& of) : listing_(of) {
  const std::scoped_lock lock(process_wide());
  if (listing_.log.is_open) throw std::logic_error("unit 26 is in use: it belongs to the whole process");
  const signals_wait until_unlinked;
  std::string path;
#ifdef __linux__
  // In memory, because on a full disk the listing's run-time library loses lines without an error.
  file_ = memfd_create("contct-unit26", MFD_CLOEXEC);
  path = "/proc/self/fd/" + std::to_string(file_);
#endif
  const bool in_memory = file_ >= 0 && access(path.c_str(), R_OK | W_OK) == 0;
  if (!in_memory) {
    if (file_ >= 0) close(file_);
    path = (std::filesystem::temp_directory_path() / "contct-unit26-XXXXXX").string();
    file_ = mkstemp(path.data());
  }
  if (file_ < 0)
    throw std::system_error(errno, std::generic_category(), "cannot make a file for unit 26: " + path);
  const int status = listing_.log.open(path.data(), static_cast<int>(path.size()));
  if (!in_memory) unlink(path.c_str());  // this object and the run-time library have opened the file
  if (status != 0) {
    close(file_);
    throw std::runtime_error("cannot connect unit 26 to " + path);
  }
  listing_.log.is_open = true;
}

unit_26::~unit_26() {
  const std::scoped_lock lock(process_wide());
  listing_.log.close();
  close(file_);
  listing_.log.is_open = false;
}

std::string unit_26::take() {
  const std::scoped_lock lock(process_wide());
  listing_.log.flush();
  std::string text;
  char block[1 << 14];
  ssize_t got = 0;
  do {
    got = pread(file_, block, sizeof block, static_cast<off_t>(taken_ + text.size()));
    if (got < 0) throw std::system_error(errno, std::generic_category(), "cannot read the file of unit 26");
    text.append(block, got);
  } while (got == sizeof block);
  taken_ += text.size();
  if (taken_ >= enough_text) begin_anew();
  return text;
}

void unit_26::begin_anew() {
  listing_.log.rewind();
  if (ftruncate(file_, 0) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot empty the file of unit 26");
  taken_ = 0;
}

}  // namespace contct::fortran
