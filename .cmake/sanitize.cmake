# A build for finding faults, some times slower: -DMELTFRONT_SANITIZE=address,undefined or thread. Threads of OpenMP are seen by
# no sanitizer of g++ (its libgomp is not built for it), so that `thread` tells of other threads only. Clang (16 or later, with
# its runtime: clang-19 libclang-rt-19-dev libomp-19-dev) compiles several times faster where both addresses and undefined
# behaviour are watched.
set(MELTFRONT_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread")
if(MELTFRONT_SANITIZE)
  add_compile_options(-fsanitize=${MELTFRONT_SANITIZE} -fno-omit-frame-pointer -g1)
  add_compile_definitions(MELTFRONT_SANITIZE)
  add_link_options(-fsanitize=${MELTFRONT_SANITIZE})
  if(MELTFRONT_SANITIZE MATCHES "undefined")
    # A finding is to fail the test that it is made in.
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # Shared libraries are linked without a symbol left open: the runtime must be one, too.
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libclang_rt.asan-x86_64.so OUTPUT_VARIABLE runtime_library
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    cmake_path(GET runtime_library PARENT_PATH runtime)
    add_link_options(-shared-libsan LINKER:-rpath,${runtime})
  endif()
endif()
