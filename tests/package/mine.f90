!> A Fortran program of today with the 1989 code in it: both precisions.
program mine
  use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int
  use contct_c, only: contct_call_r4, contct_call_r8
  implicit none
  logical :: right(2)
  call call_it_in_double_precision(right(1))
  call call_it_as_printed(right(2))
  print '(a, i0, a)', '2 facts, ', count(.not. right), ' wrong'
  if (.not. all(right)) stop 1

contains

  !> Two free ends that rise towards faces above them: the first touches after a quarter of the load.
  subroutine call_it_in_double_precision(right)
    logical, intent(out) :: right
    real(c_double) :: d(2), d_star(2), faces(2), s(2), smin
    integer(c_int) :: nodes(2), status(2), above(2)
    d = 0                      ! D
    d_star = [2, 1]            ! what the remaining load would add
    faces = [0.5d0, 0.75d0]
    nodes = [1, 2]
    above = 1
    status = 1                 ! separated
    call contct_call_r8(d, d_star, faces, s, smin, nodes, status, above, 2, 1, 1)
    right = smin == 0.25d0 .and. all(s == [0.25d0, 0.75d0]) .and. all(status == [-1, 1])
  end subroutine call_it_in_double_precision

  !> Three dofs a node, the second deflects; a pair of node 2 breaks.
  subroutine call_it_as_printed(right)
    logical, intent(out) :: right
    real(c_float) :: s(1), smin
    integer(c_int) :: status(1)
    status = -1
    call contct_call_r4([9., 9., 9., 9., 1., 9.], [9., 9., 9., 9., -8., 9.], [0.5], s, smin, [2], status, [-1], 1, 2, 3)
    right = smin == 0.0625 .and. s(1) == smin .and. status(1) == 1
  end subroutine call_it_as_printed

end program mine
