!> An empty kernel in Fortran: a plug-in that answers every call and computes nothing yet.
module my_kernel
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  implicit none

contains

  integer(c_int) function contct_kernel_abi() bind(C)
    contct_kernel_abi = 1
  end function contct_kernel_abi

  subroutine contct_kernel(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof) bind(C)
    integer(c_int), intent(in), value :: nc, indof, ndofpn, ndof
    real(c_double), intent(in) :: dd(ndof), dtest(ndof), cc(nc)
    real(c_double), intent(out) :: ss(nc), smin
    integer(c_int), intent(in) :: id(nc), isurf(nc)
    integer(c_int), intent(inout) :: isep(nc)
    smin = 0
    ss = 0
  end subroutine contct_kernel

end module my_kernel
