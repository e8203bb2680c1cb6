! Drives the module fpz along the four-stage path of data/paths/four_stage.json and writes the history; then the batch
! call on two points.
!   four_stage HISTORY.csv
program four_stage
  use fpz
  implicit none
  real(c_double), parameter :: properties(13) = &
    [0.4d9, 0.25d0, 1540d0, 0.6d6, 1d6, 33d0, 4d0, 18d-6, 1d13, 1d11, 4d-3, 0d0, 1d0]
  integer, parameter :: legs = 4
  integer, parameter :: increments(legs) = [12000, 2000, 300, 1300]
  real(c_double), parameter :: direction(3, legs) = reshape( &
    [3d-7, 0d0, 0d0, 3d-7, 0d0, 15d-7, -3d-7, 0d0, -15d-7, 3d-7, 0d0, 15d-7], [3, legs])
  real(c_double) :: state(23), energies(2), tangent(3, 3)
  type(c_ptr) :: rock
  character(len=1000) :: file
  integer :: leg, k, unit

  if (fpz_interface_version() /= fpz_interface) stop 1
  if (fpz_version() /= '0.1.0') stop 2
  if (fpz_property_name(10) /= 'rve_length') stop 2
  if (fpz_property_name(99) /= '') stop 3
  if (fpz_state_name(fpz_plane_strain, 22) /= 'damage') stop 3
  if (fpz_material_new(fpz_plane_strain, properties, 9, rock) /= fpz_invalid_input) stop 4
  if (fpz_message() /= '9 properties are given; missing: shear_stiffness'//new_line('a')) stop 5
  if (fpz_material_new(fpz_plane_strain, properties, size(properties), rock) /= fpz_ok) stop 6
  call get_command_argument(1, file)
  open (newunit=unit, file=trim(file), action='write', status='replace')
  write (unit, '(a)') 'time,eps_xx,eps_yy,eps_xy,sig_xx,sig_yy,sig_xy,cracked,n_x,n_y,t_n,t_s1,u_n,u_s1,up_s,D,'// &
    'energy_stored,energy_dissipated'
  state = 0
  do leg = 1, legs
    do k = 1, increments(leg)
      if (fpz_update_in_place(rock, state, direction(:, leg), tangent, energies) /= fpz_ok) stop 7
      write (unit, '(es24.16e3, 17(",", es24.16e3))') leg - 1 + dble(k) / increments(leg), state(1:9), state(12:15), &
        state(20), state(23), energies
    end do
  end do
  close (unit)
  call batch
  call fpz_material_free(rock)

contains

  subroutine batch
    real(c_double), target :: states(23, 2), steps(3, 2), energy(2, 2)
    integer(c_int), target :: statuses(2)
    real(c_double) :: alone(23)
    type(fpz_batch) :: job
    type(fpz_report) :: report
    integer :: i
    states = 0
    energy = 0
    statuses = -1
    steps = reshape([1d-5, 0d0, 0d0, 5d-3, 0d0, 1d-3], [3, 2])
    job%points = 2
    job%begin = fpz_array(c_loc(states), 23, 1)
    job%end = job%begin
    job%strain_increments = fpz_array(c_loc(steps), 3, 1)
    job%energies = fpz_array(c_loc(energy), 2, 1)
    job%statuses = c_loc(statuses)
    if (fpz_update_batch(rock, job, report) /= fpz_ok) stop 8
    if (report%cracked /= 1 .or. report%new_cracks /= 1 .or. any(statuses /= fpz_ok)) stop 9
    do i = 1, 2
      alone = 0
      if (fpz_update_in_place(rock, alone, steps(:, i)) /= fpz_ok) stop 10
      if (any(abs(alone - states(:, i)) > 0)) stop 11
    end do
    if (.not. energy(2, 2) > 0) stop 12
  end subroutine
end program
