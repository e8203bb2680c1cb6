! Pulls one point of rock apart until it is broken, by the UMAT: strain, stress and damage as a table.
program umat_tension
  implicit none
  integer, parameter :: ndi = 3, nshr = 1, ntens = 4, nstatv = 23, nprops = 11
  ! E, nu, density, tensile strength, cohesion, friction and dilation angle (degrees), delta0, Kn, Ks, H: SI units. What is
  ! missing at the end has its default.
  double precision :: props(nprops) = [0.4d9, 0.25d0, 1540d0, 0.6d6, 1d6, 33d0, 4d0, 18d-6, 1d13, 1d11, 4d-3]
  double precision :: stress(ntens) = 0, statev(nstatv) = 0, stran(ntens) = 0, dstran(ntens) = [1d-4, 0d0, 0d0, 0d0]
  double precision :: ddsdde(ntens, ntens), sse, spd, pnewdt, none(9)
  double precision :: drot(3, 3) = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])
  integer :: k, element = 1, point = 1, no
  character(len=80) :: name = 'ROCK'
  external :: umat

  do k = 1, 100
    pnewdt = 1
    call umat(stress, statev, ddsdde, sse, spd, none, none, none, none, none, stran, dstran, none, none, none, none, &
      none, none, name, ndi, nshr, ntens, nstatv, props, nprops, none, drot, pnewdt, none, none, none, element, point, &
      no, no, no, no)
    if (pnewdt < 1) stop 1  ! the message is on the terminal
    stran = stran + dstran
    if (mod(k, 10) == 0) write (*, '(f10.4, f13.1, f9.5)') stran(1), stress(1), statev(nstatv)
  end do
end program
