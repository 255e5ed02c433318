!> Procedures for C that call the 1989 code and control its unit 26. bind(C) has no names, so that the preprocessor
!> can rename the procedures for a second compiler, whose run-time library has its own unit 26 (flang.cmake).
!>
!> contct.f is compiled twice: as CONTC4 with the default REAL, as printed, and as CONTC8 with 8-byte REAL. Both
!> subroutines share COMMON /DOF/ and unit 26, which are global to the process, so the caller must serialise the
!> calls.
!>
!> Unit 26 is connected to the null device until contct_log_open connects it to a file, so that the listing never
!> creates fort.26.
module contct_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float, c_int
  implicit none
  private
  public :: contct_call_r4, contct_call_r8
  public :: contct_log_open, contct_log_flush, contct_log_rewind, contct_log_close

  integer, parameter :: log_unit = 26
  logical, save :: log_is_connected = .false.

  interface
    !> contct.f as printed, with REAL in single precision.
    subroutine contc4(dd, dtest, cc, ss, smin, id, isep, isurf, nc)
      import :: c_float, c_int
      real(c_float), intent(in) :: dd(*), dtest(*), cc(*)
      real(c_float), intent(inout) :: ss(*)
      real(c_float), intent(out) :: smin
      integer(c_int), intent(in) :: id(*), isurf(*), nc
      integer(c_int), intent(inout) :: isep(*)
    end subroutine contc4

    !> contct.f compiled with -fdefault-real-8: REAL, literals and DATA have double precision.
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

  !> Answers one call in single precision. The arguments are the listing's, then COMMON /DOF/.
  subroutine contct_call_r4(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn) &
    bind(C)
    real(c_float), intent(in) :: dd(*), dtest(*)       !< [system dofs]
    real(c_float), intent(in) :: cc(*)                 !< [nc]
    real(c_float), intent(inout) :: ss(*)              !< [nc] output
    real(c_float), intent(out) :: smin
    integer(c_int), intent(in) :: id(*)                !< [nc] from 1
    integer(c_int), intent(inout) :: isep(*)           !< [nc] +1 separated, -1 in contact
    integer(c_int), intent(in) :: isurf(*)             !< [nc] +1 above, -1 below
    integer(c_int), intent(in), value :: nc, indof, ndofpn
    call set_common(indof, ndofpn)
    call contc4(dd, dtest, cc, ss, smin, id, isep, isurf, nc)
  end subroutine contct_call_r4

  !> Answers one call in double precision; the arguments are those of contct_call_r4.
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

  !> Sets COMMON /DOF/, and connects unit 26 to the null device if it is not connected.
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

  !> Connects unit 26 to the beginning of the existing file `path` of `length` characters.
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

  !> Flushes unit 26, so that the file has all text that the listing has written.
  subroutine contct_log_flush() bind(C)
    flush (log_unit)
  end subroutine contct_log_flush

  !> Rewinds unit 26, so that the next line overwrites the beginning of its file.
  subroutine contct_log_rewind() bind(C)
    rewind (log_unit)
  end subroutine contct_log_rewind

  !> Closes the file of unit 26; the next call connects unit 26 to the null device again.
  subroutine contct_log_close() bind(C)
    integer :: status
    close (log_unit, iostat=status)  ! status is ignored: the file may have been removed
    log_is_connected = .false.
  end subroutine contct_log_close

end module contct_c
