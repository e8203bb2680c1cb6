! Drives the UMAT along the four-stage path of data/paths/four_stage.json, as a finite-element program calls it, and
! writes the history. Nothing here is C++, and arguments that a UMAT need not look at are left without a value.
!   four_stage HISTORY.csv [STEPS]   STEPS: every leg in at most so many increments (for slow checkers)
program four_stage
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  implicit none
  integer, parameter :: ndi = 3, nshr = 1, ntens = 4, nstatv = 23, nprops = 13
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd
  double precision :: stran(ntens), dstran(ntens), props(nprops), drot(3, 3), pnewdt
  double precision, allocatable :: unset(:)
  integer, allocatable :: unset_integer(:)
  character(len=80) :: cmname
  character(len=1000) :: text
  integer :: leg, k, unit, steps, most, noel, npt
  integer, parameter :: legs = 4
  integer, parameter :: increments(legs) = [12000, 2000, 300, 1300]
  double precision, parameter :: direction(2, legs) = reshape( &
    [3d-7, 0d0, 3d-7, 15d-7, -3d-7, -15d-7, 3d-7, 15d-7], [2, legs])
  external :: umat

  ! Johnstone, Table 1; H = 4 mm; the published zone. The integrator has its defaults.
  props = [0.4d9, 0.25d0, 1540d0, 0.6d6, 1d6, 33d0, 4d0, 18d-6, 1d13, 1d11, 4d-3, 0d0, 1d0]
  most = huge(most)
  call get_command_argument(2, text)
  if (text /= '') read (text, *) most
  call get_command_argument(1, text)
  open (newunit=unit, file=trim(text), action='write', status='replace')
  write (unit, '(a)') 'time,eps_xx,eps_yy,eps_xy,sig_xx,sig_yy,sig_zz,sig_xy,cracked,D,energy_stored,energy_dissipated'
  allocate (unset(9), unset_integer(1))
  stress = 0
  statev = 0
  stran = 0
  noel = 1
  npt = 1
  drot = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])
  do leg = 1, legs
    steps = min(increments(leg), most)
    do k = 1, steps
      dstran = 0
      dstran(1) = direction(1, leg)
      dstran(4) = 2 * direction(2, leg)
      if (steps < increments(leg)) dstran = dstran * increments(leg) / steps
      pnewdt = 1
      call umat(stress, statev, ddsdde, sse, spd, unset, unset, unset, unset, unset, stran, dstran, unset, unset, &
        unset, unset, unset, unset, cmname, ndi, nshr, ntens, nstatv, props, nprops, unset, drot, pnewdt, unset, &
        unset, unset, noel, npt, unset_integer, unset_integer, unset_integer, unset_integer)
      if (pnewdt < 1) stop 1
      stran = stran + dstran
      if (any(ieee_is_nan(ddsdde))) stop 2
      write (unit, '(es24.16e3, 11(",", es24.16e3))') leg - 1 + dble(k) / steps, stran(1), stran(2), stran(4) / 2, &
        stress(1), stress(2), stress(3), stress(4), statev(7), statev(nstatv), sse, spd
    end do
  end do
  close (unit)
end program
