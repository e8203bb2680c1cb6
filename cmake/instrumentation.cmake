# Sanitizers and coverage apply to every target of the build. FPZ_INSTRUMENT_FLAGS holds the flags, because a program
# outside this build that links the instrumented static library needs them too (tests/consumer).
set(FPZ_INSTRUMENT_FLAGS "")
if(FPZ_SANITIZE)
  # Null, alignment, object-size and vptr checks multiply the compile time of templates by more than two, and what they
  # could find here faults under the address sanitizer as well.
  list(APPEND FPZ_INSTRUMENT_FLAGS -fsanitize=${FPZ_SANITIZE} -fno-sanitize=null,alignment,object-size,vptr
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
endif()
if(FPZ_COVERAGE)
  list(APPEND FPZ_INSTRUMENT_FLAGS --coverage)
endif()
add_compile_options(${FPZ_INSTRUMENT_FLAGS})
add_link_options(${FPZ_INSTRUMENT_FLAGS})
