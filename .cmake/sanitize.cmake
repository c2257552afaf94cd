# A build for finding faults, some times slower: -DMELTFRONT_SANITIZE=address,undefined or thread. Threads of OpenMP are seen by
# no sanitizer of g++ (its libgomp is not built for it), so that `thread` tells of other threads only.
set(MELTFRONT_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread")
if(MELTFRONT_SANITIZE)
  add_compile_options(-fsanitize=${MELTFRONT_SANITIZE} -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${MELTFRONT_SANITIZE})
  if(MELTFRONT_SANITIZE MATCHES "undefined")
    # A finding is to fail the test that it is made in.
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()
