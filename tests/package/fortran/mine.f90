!> A Fortran program of today with the 1989 code in it: both precisions.
program mine
  use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int
  use contct_c, only: contct_call_r4, contct_call_r8
  implicit none
  integer :: checked = 0, wrong = 0

  call call_it_in_double_precision
  call call_it_as_printed
  print '(i0, a, i0, a)', checked, ' facts, ', wrong, ' wrong'
  if (wrong /= 0) stop 1

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    checked = checked + 1
    if (holds) return
    wrong = wrong + 1
    print '(2a)', 'wrong: ', what
  end subroutine check

  !> Two free ends that rise towards faces above them: the first touches after a quarter of the load.
  subroutine call_it_in_double_precision
    real(c_double) :: d(2), d_star(2), faces(2), s(2), smin
    integer(c_int) :: nodes(2), status(2), above(2)
    d = 0                      ! D
    d_star = [2, 1]            ! what the remaining load would add
    faces = [0.5d0, 0.75d0]
    nodes = [1, 2]
    above = 1
    status = 1                 ! separated
    call contct_call_r8(d, d_star, faces, s, smin, nodes, status, above, 2, 1, 1)
    call check(smin == 0.25d0 .and. s(1) == 0.25d0 .and. s(2) == 0.75d0, 'SMIN and SS')
    call check(status(1) == -1 .and. status(2) == 1, 'ISEP')
  end subroutine call_it_in_double_precision

  !> Three dofs a node, the second deflects; a pair of node 2 breaks.
  subroutine call_it_as_printed
    real(c_float) :: d(6), d_star(6), s(1), smin
    integer(c_int) :: status(1)
    d = 9
    d(5) = 1
    d_star = 9
    d_star(5) = -8
    status = -1
    call contct_call_r4(d, d_star, [0.5_c_float], s, smin, [2_c_int], status, [-1_c_int], 1, 2, 3)
    call check(smin == 0.0625 .and. s(1) == smin .and. status(1) == 1, 'an answer in single precision')
  end subroutine call_it_as_printed

end program mine
