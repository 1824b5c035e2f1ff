# The batch kernels are built once for each instruction set and chosen at run time (kernel/batch/dispatch.cpp). Only these
# files get flags beyond the baseline; they include neither std containers nor Eigen.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  set_source_files_properties(kernel/batch/kernels_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
  set_source_files_properties(kernel/batch/kernels_avx512.cpp PROPERTIES
    COMPILE_OPTIONS "-mavx2;-mfma;-mavx512f;-mprefer-vector-width=512")
  set_source_files_properties(kernel/batch/dispatch.cpp PROPERTIES COMPILE_DEFINITIONS TRIMLOOP_X86_KERNELS)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")  # vectors of four doubles never leave the file
  set_source_files_properties(kernel/batch/kernels_baseline.cpp PROPERTIES COMPILE_OPTIONS -Wno-psabi)
endif()
if(TRIMLOOP_SANITIZE)  # unrolled arithmetic on pointers that the callers have checked: minutes to compile with checks
  foreach(build baseline avx2 avx512)
    set_property(SOURCE kernel/batch/kernels_${build}.cpp APPEND PROPERTY COMPILE_OPTIONS -fno-sanitize=all)
  endforeach()
endif()
