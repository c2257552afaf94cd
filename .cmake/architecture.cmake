# Which instructions the compiler may use: one set for every target, because Eigen's alignment is part of the ABI.
#   MELTFRONT_KERNELS       see libraries.cmake
#   MELTFRONT_ARCHITECTURE  what -march takes (x86-64-v2, x86-64-v3, native, ...); empty: x86-64-v3, or x86-64-v2 on a
#                           processor that lacks it; on other processors than x86-64 the compiler's own default
set(MELTFRONT_ARCHITECTURE "" CACHE STRING "What -march takes; empty: x86-64-v3, x86-64-v2 on a processor that lacks it")

set(architecture "${MELTFRONT_ARCHITECTURE}")
if(NOT architecture AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  try_run(processor_lacks_v3 processor_check_compiles ${CMAKE_BINARY_DIR}/processor_check
          ${PROJECT_SOURCE_DIR}/.cmake/processor_check.cc)
  if(processor_check_compiles AND "${processor_lacks_v3}" STREQUAL "0")
    set(architecture x86-64-v3)
  else()
    set(architecture x86-64-v2)
  endif()
endif()
set(architecture_flags)
if(architecture)
  list(APPEND architecture_flags -march=${architecture})
endif()
# g++ 12 miscompiles constants of structures with AVX-512 at -O3: none of it, whatever is asked for.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
   AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  list(APPEND architecture_flags -mno-avx512f)
endif()
add_compile_options(${architecture_flags})
if(MELTFRONT_KERNELS)
  # Libraries of several levels in one program agree about where Eigen's arrays lie.
  add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=16)
endif()

# With the very flags of the build, run: what this compiler is known to get wrong must come out right.
set(check_key "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE} ${architecture_flags}")
if(NOT "${MELTFRONT_COMPILER_CHECKED}" STREQUAL "${check_key}")
  unset(compiler_check_result CACHE)
  unset(compiler_check_compiles CACHE)
  separate_arguments(check_flags UNIX_COMMAND "${CMAKE_CXX_FLAGS_RELEASE}")
  try_run(compiler_check_result compiler_check_compiles ${CMAKE_BINARY_DIR}/compiler_check
          ${PROJECT_SOURCE_DIR}/.cmake/compiler_check.cc
          COMPILE_DEFINITIONS ${check_flags} ${architecture_flags})
  if(NOT compiler_check_compiles)
    message(FATAL_ERROR "The compiler does not take the flags '${check_key}'. Set MELTFRONT_ARCHITECTURE to what its -march takes, for instance x86-64-v3.")
  elseif("${compiler_check_result}" STREQUAL "1")
    message(FATAL_ERROR "The compiler ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} miscompiles initial values of vectors with the flags '${check_key}': results would be wrong in silence. Build with -DMELTFRONT_ARCHITECTURE=x86-64-v3 and without -mavx512f in CMAKE_CXX_FLAGS, or with -fno-tree-slp-vectorize, or with another compiler.")
  elseif(NOT "${compiler_check_result}" STREQUAL "0")
    message(FATAL_ERROR "A program compiled with the flags '${check_key}' does not run on this processor (${compiler_check_result}). Set MELTFRONT_ARCHITECTURE to x86-64-v2 or native.")
  endif()
  set(MELTFRONT_COMPILER_CHECKED "${check_key}" CACHE INTERNAL "Flags with which the compiler was checked")
endif()
