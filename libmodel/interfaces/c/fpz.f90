! The model for Fortran: fpz.h with iso_c_binding. Compile this file with your program and link libfpz:
!   gfortran fpz.f90 program.f90 -lfpz
! All that is said in fpz.h holds here. Properties and components of states count from 0 in the functions that name them,
! as in C. A null pointer (c_null_ptr) stands for an array that is not wanted.
module fpz
  use, intrinsic :: iso_c_binding
  implicit none
  public

  integer(c_int), parameter :: fpz_interface = 1  ! what fpz_interface_version() must return
  integer(c_int), parameter :: fpz_plane_strain = 0, fpz_plane_stress = 1, fpz_three_d = 2
  integer(c_int), parameter :: fpz_ok = 0, fpz_non_convergence = 1, fpz_snap_back = 2, fpz_no_plastic_flow = 3, &
                               fpz_invalid_input = 4

  ! Component k of point i, both from 0, is data(1 + i * point + k * component).
  type, bind(C) :: fpz_array
    type(c_ptr) :: data = c_null_ptr
    integer(c_intptr_t) :: point = 0
    integer(c_intptr_t) :: component = 1
  end type

  type, bind(C) :: fpz_batch
    integer(c_size_t) :: points = 0
    type(fpz_array) :: begin
    type(fpz_array) :: strain_increments
    type(fpz_array) :: end
    type(fpz_array) :: tangents
    type(fpz_array) :: energies
    type(c_ptr) :: lengths = c_null_ptr
    type(c_ptr) :: statuses = c_null_ptr
    integer(c_int) :: threads = 0
  end type

  type, bind(C) :: fpz_report
    integer(c_size_t) :: failed = 0
    integer(c_size_t) :: first_failed = 0  ! counts from 0
    integer(c_size_t) :: cracked = 0
    integer(c_size_t) :: new_cracks = 0
    integer(c_long_long) :: iterations = 0
  end type

  interface
    function fpz_interface_version() bind(C)
      import :: c_int
      integer(c_int) :: fpz_interface_version
    end function
    function fpz_version_c() bind(C, name='fpz_version')
      import :: c_ptr
      type(c_ptr) :: fpz_version_c
    end function
    function fpz_status_word_c(status) bind(C, name='fpz_status_word')
      import :: c_ptr, c_int
      integer(c_int), value :: status
      type(c_ptr) :: fpz_status_word_c
    end function
    function fpz_message_c() bind(C, name='fpz_message')
      import :: c_ptr
      type(c_ptr) :: fpz_message_c
    end function
    subroutine fpz_capture_failures_c(folder) bind(C, name='fpz_capture_failures')
      import :: c_char
      character(kind=c_char), intent(in) :: folder(*)
    end subroutine
    function fpz_property_count() bind(C)
      import :: c_int
      integer(c_int) :: fpz_property_count
    end function
    function fpz_property_name_c(k) bind(C, name='fpz_property_name')
      import :: c_ptr, c_int
      integer(c_int), value :: k
      type(c_ptr) :: fpz_property_name_c
    end function
    function fpz_property_unit_c(k) bind(C, name='fpz_property_unit')
      import :: c_ptr, c_int
      integer(c_int), value :: k
      type(c_ptr) :: fpz_property_unit_c
    end function
    function fpz_property_values_c(k) bind(C, name='fpz_property_values')
      import :: c_ptr, c_int
      integer(c_int), value :: k
      type(c_ptr) :: fpz_property_values_c
    end function
    function fpz_property_default(k) bind(C)
      import :: c_double, c_int
      integer(c_int), value :: k
      real(c_double) :: fpz_property_default
    end function
    function fpz_tensor_size(setting) bind(C)
      import :: c_int
      integer(c_int), value :: setting
      integer(c_int) :: fpz_tensor_size
    end function
    function fpz_state_size(setting) bind(C)
      import :: c_int
      integer(c_int), value :: setting
      integer(c_int) :: fpz_state_size
    end function
    function fpz_state_name_c(setting, k) bind(C, name='fpz_state_name')
      import :: c_ptr, c_int
      integer(c_int), value :: setting, k
      type(c_ptr) :: fpz_state_name_c
    end function
    function fpz_material_new(setting, properties, count, material) bind(C)
      import :: c_ptr, c_int, c_double
      integer(c_int), value :: setting
      real(c_double), intent(in) :: properties(*)
      integer(c_int), value :: count
      type(c_ptr), intent(out) :: material
      integer(c_int) :: fpz_material_new
    end function
    subroutine fpz_material_free(material) bind(C)
      import :: c_ptr
      type(c_ptr), value :: material
    end subroutine
    function fpz_material_warnings_c(material) bind(C, name='fpz_material_warnings')
      import :: c_ptr
      type(c_ptr), value :: material
      type(c_ptr) :: fpz_material_warnings_c
    end function
    function fpz_material_snap_back_length(material) bind(C)
      import :: c_ptr, c_double
      type(c_ptr), value :: material
      real(c_double) :: fpz_material_snap_back_length
    end function
    function fpz_material_set_length(material, rve_length) bind(C)
      import :: c_ptr, c_int, c_double
      type(c_ptr), value :: material
      real(c_double), value :: rve_length
      integer(c_int) :: fpz_material_set_length
    end function
    ! tangent(j, i) is d(stress_i)/d(tensor strain_j). begin_state and end_state may be the same array only through
    ! fpz_update_in_place.
    function fpz_update(material, begin_state, strain_increment, end_state, tangent, energies) bind(C)
      import :: c_ptr, c_int, c_double
      type(c_ptr), value :: material
      real(c_double), intent(in) :: begin_state(*), strain_increment(*)
      real(c_double), intent(inout) :: end_state(*)
      real(c_double), intent(inout), optional :: tangent(*), energies(2)
      integer(c_int) :: fpz_update
    end function
    ! batch is inout because what it points to changes: with intent(in) compilers keep old values of the results.
    function fpz_update_batch(material, batch, report) bind(C)
      import :: c_ptr, c_int, fpz_batch, fpz_report
      type(c_ptr), value :: material
      type(fpz_batch), intent(inout) :: batch
      type(fpz_report), intent(out) :: report
      integer(c_int) :: fpz_update_batch
    end function
    pure function fpz_strlen(text) bind(C, name='strlen')
      import :: c_ptr, c_size_t
      type(c_ptr), value, intent(in) :: text
      integer(c_size_t) :: fpz_strlen
    end function
  end interface

contains

  function fpz_version() result(text)
    character(len=:), allocatable :: text
    text = fpz_text(fpz_version_c())
  end function

  function fpz_message() result(text)
    character(len=:), allocatable :: text
    text = fpz_text(fpz_message_c())
  end function

  function fpz_status_word(status) result(text)
    integer(c_int), intent(in) :: status
    character(len=:), allocatable :: text
    text = fpz_text(fpz_status_word_c(status))
  end function

  function fpz_property_name(k) result(text)
    integer(c_int), intent(in) :: k
    character(len=:), allocatable :: text
    text = fpz_text(fpz_property_name_c(k))
  end function

  function fpz_property_unit(k) result(text)
    integer(c_int), intent(in) :: k
    character(len=:), allocatable :: text
    text = fpz_text(fpz_property_unit_c(k))
  end function

  function fpz_property_values(k) result(text)
    integer(c_int), intent(in) :: k
    character(len=:), allocatable :: text
    text = fpz_text(fpz_property_values_c(k))
  end function

  function fpz_state_name(setting, k) result(text)
    integer(c_int), intent(in) :: setting, k
    character(len=:), allocatable :: text
    text = fpz_text(fpz_state_name_c(setting, k))
  end function

  function fpz_material_warnings(material) result(text)
    type(c_ptr), intent(in) :: material
    character(len=:), allocatable :: text
    text = fpz_text(fpz_material_warnings_c(material))
  end function

  ! Failing updates are written into the folder; an empty name: where the environment says.
  subroutine fpz_capture_failures(folder)
    character(len=*), intent(in) :: folder
    call fpz_capture_failures_c(trim(folder)//c_null_char)
  end subroutine

  ! fpz_update with one state that is replaced. Fortran does not allow one array in two arguments of which one changes.
  function fpz_update_in_place(material, state, strain_increment, tangent, energies) result(status)
    type(c_ptr), intent(in) :: material
    real(c_double), intent(inout) :: state(:)
    real(c_double), intent(in) :: strain_increment(:)
    real(c_double), intent(inout), optional :: tangent(:, :), energies(2)
    integer(c_int) :: status
    real(c_double) :: next(size(state))
    status = fpz_update(material, state, strain_increment, next, tangent, energies)
    if (status == fpz_ok) state = next
  end function

  ! The text of a C string; empty for a null pointer.
  function fpz_text(pointer) result(text)
    type(c_ptr), intent(in) :: pointer
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: k, length
    if (.not. c_associated(pointer)) then
      text = ''
      return
    end if
    length = int(fpz_strlen(pointer))
    call c_f_pointer(pointer, letters, [length])
    allocate (character(len=length) :: text)
    do k = 1, length
      text(k:k) = letters(k)
    end do
  end function

end module
