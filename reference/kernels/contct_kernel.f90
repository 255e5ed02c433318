!> CONTCT in today's Fortran, as a plug-in: start yours from here.
!>
!>   gfortran -std=f2018 -O2 -ffp-contract=off -shared -fPIC -o kernel_f90.so reference/kernels/contct_kernel.f90
!>   build/release/contct fuzz --kernels fortran,plugin:kernel_f90.so
!>
!> -ffp-contract=off: without it some machines round a product and a sum once where the listing rounds twice.
module contct_kernel_f90
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  implicit none

  ! The listing's DATA statement. The kind makes each literal the double nearest to it.
  real(c_double), parameter :: delta = 1.e-20_c_double         ! what an event at once is scaled by
  real(c_double), parameter :: epsgap = 1.e-10_c_double        ! a gap below this length is none
  real(c_double), parameter :: epsmul = .390625e-02_c_double   ! pairs this close to the earliest go with it

contains

  !> Which ABI this library was written to.
  integer(c_int) function contct_kernel_abi() bind(C)
    contct_kernel_abi = 1
  end function contct_kernel_abi

  !> The names are C's, the argument list is the listing's, then COMMON /DOF/ and the number of dofs. Scalars
  !> that go in come by VALUE.
  subroutine contct_kernel(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof) bind(C)
    integer(c_int), intent(in), value :: nc, indof, ndofpn, ndof
    real(c_double), intent(in) :: dd(ndof), dtest(ndof), cc(nc)
    real(c_double), intent(out) :: ss(nc), smin
    integer(c_int), intent(in) :: id(nc), isurf(nc)
    integer(c_int), intent(inout) :: isep(nc)
    integer :: i, dof

    ! The scale factor of every pair, and the earliest that is still to come.
    smin = 1
    do i = 1, nc
      dof = (id(i) - 1) * ndofpn + indof
      ss(i) = scale_factor(dd(dof), dtest(dof), cc(i), isep(i) * isurf(i))
      if (ss(i) > 0 .and. ss(i) < smin) smin = ss(i)
    end do
    if (smin == 1) return  ! no event: all of the load can be applied

    ! Toggle the earliest, and whatever comes within EPSMUL of it.
    do i = 1, nc
      if (abs(ss(i) - smin) / smin < epsmul) isep(i) = merge(-1_c_int, 1_c_int, isep(i) == 1)
    end do
  end subroutine contct_kernel

  !> The share of the remaining load at which one pair has its event; 1 when it has none. Every comparison is
  !> one that is false for NaN, as in 1989: turn none of them round.
  pure function scale_factor(d, d_star, face, side) result(s)
    real(c_double), intent(in) :: d, d_star, face
    integer(c_int), intent(in) :: side  ! isep * isurf
    real(c_double) :: s, gap
    gap = face - d
    s = 1
    if (d_star == 0) return        ! it does not move
    if (abs(gap) < epsgap) then    ! it touches: does it move away, or in?
      if (side / d_star > 0) s = side / d_star * delta
    else
      s = gap / d_star
    end if
  end function scale_factor

end module contct_kernel_f90
