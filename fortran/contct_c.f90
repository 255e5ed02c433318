!> C calls into the 1989 code: the library's only file with bind(C). The procedures' names in C
!> are their own, so that a second compiler's preprocessor can rename them (fortran/flang.cmake): unit 26
!> belongs to each compiler's run-time library.
!>
!> Two builds of contct.f stand behind it, CONTC4 (default REAL, as printed) and CONTC8
!> (8-byte REAL). Both share COMMON /DOF/ and write to unit 26, and both of these are global
!> to the process: calls must be serialised by the caller.
!>
!> Unit 26 is connected to the null device until contct_log_open gives it a file, so that the
!> listing never leaves a fort.26 behind.
module contct_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float, c_int
  implicit none
  private
  public :: contct_call_r4, contct_call_r8
  public :: contct_log_open, contct_log_flush, contct_log_rewind, contct_log_close

  integer, parameter :: log_unit = 26
  logical, save :: log_is_connected = .false.

  interface
    !> contct.f as printed: REAL is single precision.
    subroutine contc4(dd, dtest, cc, ss, smin, id, isep, isurf, nc)
      import :: c_float, c_int
      real(c_float), intent(in) :: dd(*), dtest(*), cc(*)
      real(c_float), intent(inout) :: ss(*)
      real(c_float), intent(out) :: smin
      integer(c_int), intent(in) :: id(*), isurf(*), nc
      integer(c_int), intent(inout) :: isep(*)
    end subroutine contc4

    !> contct.f with -fdefault-real-8: REAL, its literals and its DATA are double precision.
    subroutine contc8(dd, dtest, cc, ss, smin, id, isep, isurf, nc)
      import :: c_double, c_int
      real(c_double), intent(in) :: dd(*), dtest(*), cc(*)
      real(c_double), intent(inout) :: ss(*)
      real(c_double), intent(out) :: smin
      integer(c_int), intent(in) :: id(*), isurf(*), nc
      integer(c_int), intent(inout) :: isep(*)
    end subroutine contc8
  end interface

contains

  !> CONTCT in single precision. Arguments in the listing's order, then COMMON /DOF/.
  subroutine contct_call_r4(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn) &
    bind(C)
    real(c_float), intent(in) :: dd(*), dtest(*)       !< [system dofs]
    real(c_float), intent(in) :: cc(*)                 !< [nc]
    real(c_float), intent(inout) :: ss(*)              !< [nc] out
    real(c_float), intent(out) :: smin
    integer(c_int), intent(in) :: id(*)                !< [nc] from 1
    integer(c_int), intent(inout) :: isep(*)           !< [nc] +1 separated, -1 in contact
    integer(c_int), intent(in) :: isurf(*)             !< [nc] +1 above, -1 below
    integer(c_int), intent(in), value :: nc, indof, ndofpn
    call set_common(indof, ndofpn)
    call contc4(dd, dtest, cc, ss, smin, id, isep, isurf, nc)
  end subroutine contct_call_r4

  !> CONTCT in double precision. Arguments as above.
  subroutine contct_call_r8(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn) &
    bind(C)
    real(c_double), intent(in) :: dd(*), dtest(*)
    real(c_double), intent(in) :: cc(*)
    real(c_double), intent(inout) :: ss(*)
    real(c_double), intent(out) :: smin
    integer(c_int), intent(in) :: id(*)
    integer(c_int), intent(inout) :: isep(*)
    integer(c_int), intent(in) :: isurf(*)
    integer(c_int), intent(in), value :: nc, indof, ndofpn
    call set_common(indof, ndofpn)
    call contc8(dd, dtest, cc, ss, smin, id, isep, isurf, nc)
  end subroutine contct_call_r8

  !> Fill COMMON /DOF/, and make sure that unit 26 leads somewhere.
  subroutine set_common(indof_in, ndofpn_in)
    integer(c_int), intent(in) :: indof_in, ndofpn_in
    integer(c_int) :: indof, ndofpn
    common /dof/ indof, ndofpn
    integer :: status
    indof = indof_in
    ndofpn = ndofpn_in
    if (.not. log_is_connected) then
      open (unit=log_unit, file='/dev/null', form='formatted', action='write', iostat=status)
      log_is_connected = status == 0
    end if
  end subroutine set_common

  !> Connect unit 26 to the existing file `path` (`length` characters), from its beginning.
  !> Returns 0, or the run-time library's error number.
  function contct_log_open(path, length) result(status) bind(C)
    integer(c_int), intent(in), value :: length
    character(kind=c_char), intent(in) :: path(length)
    integer(c_int) :: status
    character(len=length) :: name
    integer :: i
    do i = 1, length
      name(i:i) = path(i)
    end do
    close (log_unit)
    open (unit=log_unit, file=name, form='formatted', status='old', action='readwrite', &
          position='rewind', iostat=status)
    log_is_connected = status == 0
  end function contct_log_open

  !> Flush the text: the file then has everything that the listing has written.
  subroutine contct_log_flush() bind(C)
    flush (log_unit)
  end subroutine contct_log_flush

  !> Forget the text: the next line is written at the beginning of the file.
  subroutine contct_log_rewind() bind(C)
    rewind (log_unit)
  end subroutine contct_log_rewind

  !> Take unit 26 away from its file; it leads to the null device again.
  subroutine contct_log_close() bind(C)
    integer :: status
    close (log_unit, iostat=status)  ! in a child process its file may be gone already
    log_is_connected = .false.
  end subroutine contct_log_close

end module contct_c
