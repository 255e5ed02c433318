!> A plug-in as somebody would make it of the listing itself: it has the listing's unit 26.
integer(c_int) function contct_kernel_abi() bind(C)
  use, intrinsic :: iso_c_binding, only: c_int
  implicit none
  contct_kernel_abi = 1
end function contct_kernel_abi

subroutine contct_kernel(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof) bind(C)
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  implicit none
  integer(c_int), intent(in), value :: nc, indof, ndofpn, ndof
  real(c_double), intent(in) :: dd(ndof), dtest(ndof), cc(nc)
  real(c_double), intent(out) :: ss(nc), smin
  integer(c_int), intent(in) :: id(nc), isurf(nc)
  integer(c_int), intent(inout) :: isep(nc)
  write (26, *) 'written by a plug-in', size(dd), size(dtest), size(cc), size(id), size(isep), size(isurf), indof, ndofpn
  ss = 1
  smin = 1
end subroutine contct_kernel
