!> CONTCT in modern Fortran as a plug-in, from which you can start your own kernel.
!>
!>   gfortran -std=f2018 -O2 -ffp-contract=off -shared -fPIC -o kernel_f90.so reference/kernels/contct_kernel.f90
!>   build/release/contct fuzz --kernels fortran,plugin:kernel_f90.so
!>
!> -ffp-contract=off keeps the two roundings of a product and a sum; a fused operation rounds once.
module contct_kernel_f90
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  implicit none

  ! The listing's DATA statement. A literal without a kind would be rounded to single precision.
  real(c_double), parameter :: delta = 1.e-20_c_double         ! factor of s for an event at no additional load
  real(c_double), parameter :: epsgap = 1.e-10_c_double        ! a pair with a smaller gap is at its face
  real(c_double), parameter :: epsmul = .390625e-02_c_double   ! relative distance of toggled pairs from SMIN

contains

  !> Returns the version of the ABI that this library follows.
  integer(c_int) function contct_kernel_abi() bind(C)
    contct_kernel_abi = 1
  end function contct_kernel_abi

  !> Answers one call. The arguments are the listing's, then COMMON /DOF/ and the number of dofs; scalar inputs are
  !> passed by value.
  subroutine contct_kernel(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof) bind(C)
    integer(c_int), intent(in), value :: nc, indof, ndofpn, ndof
    real(c_double), intent(in) :: dd(ndof), dtest(ndof), cc(nc)
    real(c_double), intent(out) :: ss(nc), smin
    integer(c_int), intent(in) :: id(nc), isurf(nc)
    integer(c_int), intent(inout) :: isep(nc)
    integer :: i, dof

    ! SS of every pair, and SMIN, the smallest positive SS below 1.
    smin = 1
    do i = 1, nc
      dof = (id(i) - 1) * ndofpn + indof
      ss(i) = scale_factor(dd(dof), dtest(dof), cc(i), isep(i) * isurf(i))
      if (ss(i) > 0 .and. ss(i) < smin) smin = ss(i)
    end do
    if (smin == 1) return  ! no event: the whole load can be applied

    ! Toggle all pairs whose SS is within EPSMUL of SMIN.
    do i = 1, nc
      if (abs(ss(i) - smin) / smin < epsmul) isep(i) = merge(-1_c_int, 1_c_int, isep(i) == 1)
    end do
  end subroutine contct_kernel

  !> Returns s of one pair. If s is between 0 and 1, the pair has its event at this share of the remaining load.
  !> Do not negate a comparison: all comparisons with NaN are false, as in 1989.
  pure function scale_factor(d, d_star, face, side) result(s)
    real(c_double), intent(in) :: d, d_star, face
    integer(c_int), intent(in) :: side  ! isep * isurf
    real(c_double) :: s, gap
    gap = face - d
    s = 1
    if (d_star == 0) return        ! the pair does not move
    if (abs(gap) < epsgap) then    ! at the face: an event if the motion changes the status
      if (side / d_star > 0) s = side / d_star * delta
    else
      s = gap / d_star
    end if
  end function scale_factor

end module contct_kernel_f90
