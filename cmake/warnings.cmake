# fpz_set_warnings(<target>): the warnings every target of this project is built with. Imported targets (Eigen, Ceres,
# GoogleTest, ...) are system includes, so only our own code is held to them.
function(fpz_set_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
    $<$<BOOL:${FPZ_WERROR}>:-Werror>)
  if(FPZ_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Under sanitizers g++ 12 reports uninitialised values inside Eigen expressions that are not there.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
endfunction()
