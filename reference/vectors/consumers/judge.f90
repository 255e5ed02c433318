!> Judges a kernel in Fortran:
!>   gfortran -O2 -ffp-contract=off -o judge mine.f90 judge.f90 && ./judge ../contct-vectors-1.txt
!> mine.f90 has contct_kernel as ../../kernels/contct_kernel.f90 has it. Exit status 0: equal to the bit in every call; 1: not;
!> 2: nothing was compared, or the file is cut short.
program judge
  use, intrinsic :: iso_fortran_env, only: int64
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use contct_kernel_f90, only: contct_kernel
  implicit none
  character(len=999) :: file, name
  integer :: number, bytes, indof, ndofpn, dofs, used, nc, i, dof, state, announced, seen = 0, calls = 0, wrong = 0
  real(8) :: smin, expected_smin
  real(8), allocatable :: dd(:), dtest(:), cc(:), ss(:), expected(:)
  integer, allocatable :: id(:), isep(:), isurf(:), after(:)

  call get_command_argument(1, file)
  open (10, file=file, status='old', action='read')
  read (10, *) name, name, announced
  do
    read (10, *, iostat=state) name, name, number, bytes, indof, ndofpn, dofs, used, nc, expected_smin
    if (state /= 0) exit
    dd = [(ieee_value(0.d0, ieee_quiet_nan), i = 1, dofs)]
    dtest = dd
    do i = 1, used
      read (10, *) dof, dd(dof), dtest(dof)
    end do
    if (allocated(cc)) deallocate (cc, ss, expected, id, isep, isurf, after)
    allocate (cc(nc), ss(nc), expected(nc), id(nc), isep(nc), isurf(nc), after(nc))
    do i = 1, nc
      read (10, *) id(i), isep(i), isurf(i), cc(i), expected(i), after(i)
    end do
    seen = seen + 1
    if (bytes /= 8) cycle
    call contct_kernel(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, dofs)
    calls = calls + 1
    if (same(smin, expected_smin) .and. all(same(ss, expected)) .and. all(isep == after)) cycle
    wrong = wrong + 1
    if (wrong > 1) cycle
    write (*, '(2a,i0,a)', advance='no') trim(name), ', call ', number, ': found '
    i = findloc([same(ss, expected), same(smin, expected_smin), isep == after], .false., 1)
    if (i <= nc) print '(a,i0,2(a,g0))', 'SS(', i, ') ', ss(i), ', expected ', expected(i)
    if (i == nc + 1) print '(2(a,g0))', 'SMIN ', smin, ', expected ', expected_smin
    if (i > nc + 1) print '(3(a,i0))', 'ISEP(', i - nc - 1, ') ', isep(i - nc - 1), ', expected ', after(i - nc - 1)
  end do
  print '(i0,a,i0,a)', calls, ' calls, ', wrong, ' differ'
  if (calls == 0 .or. seen /= announced) stop 2, quiet=.true.
  if (wrong > 0) stop 1, quiet=.true.
contains
  elemental logical function same(a, b)
    real(8), intent(in) :: a, b
    same = (a /= a .and. b /= b) .or. transfer(a, 0_int64) == transfer(b, 0_int64)
  end function same
end program judge
