// The 1989 code itself, called through ISO_C_BINDING (fortran/contct_c.f90), and its unit 26.
#pragma once

#include <mutex>
#include <string>

#include "contct/kernel/call.hpp"
#include "contct/kernel/compiled_listing.hpp"

namespace contct::kernels::fortran {

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

/// Unit 26 while this object lives: what the listing writes is kept and handed back. One at a time
/// for each run-time library of a process: a second one throws std::logic_error. The file behind it is
/// unlinked at once, so nothing is left behind however the process ends.
class unit_26 {
 public:
  explicit unit_26(compiled_listing& of = gfortran);
  ~unit_26();
  unit_26(const unit_26&) = delete;
  unit_26& operator=(const unit_26&) = delete;

  /// All text written since the last take, and forget it.
  [[nodiscard]] std::string take() const;

 private:
  compiled_listing& listing_;
  int file_ = -1;
};

}  // namespace contct::kernels::fortran
