! Pulls one point of rock apart until it is broken: strain, stress and damage as a table.
program tension
  use fpz
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  ! E, nu, density, tensile strength, cohesion, friction and dilation angle (degrees), delta0, Kn, Ks, H: SI units. What is
  ! missing at the end has its default.
  real(c_double), parameter :: properties(11) = &
    [0.4d9, 0.25d0, 1540d0, 0.6d6, 1d6, 33d0, 4d0, 18d-6, 1d13, 1d11, 4d-3]
  real(c_double), parameter :: increment(3) = [1d-4, 0d0, 0d0]  ! xx, yy, xy
  real(c_double), allocatable :: state(:)
  type(c_ptr) :: rock
  integer :: k

  if (fpz_interface_version() /= fpz_interface) stop 'libfpz and fpz.f90 are of different versions'
  if (fpz_material_new(fpz_plane_strain, properties, size(properties), rock) /= fpz_ok) then
    write (error_unit, '(a)') fpz_message()
    stop 1
  end if
  write (error_unit, '(a)', advance='no') fpz_material_warnings(rock)
  allocate (state(fpz_state_size(fpz_plane_strain)), source=0d0)
  write (*, '(a10, a13, a9)') fpz_state_name(fpz_plane_strain, 0), fpz_state_name(fpz_plane_strain, 3), &
    fpz_state_name(fpz_plane_strain, 22)
  do k = 1, 100
    if (fpz_update_in_place(rock, state, increment) /= fpz_ok) then
      write (error_unit, '(a)') fpz_message()
      stop 1
    end if
    if (mod(k, 10) == 0) write (*, '(f10.4, f13.1, f9.5)') state(1), state(4), state(23)
  end do
  call fpz_material_free(rock)
end program
