# Where libraries stand, in the build as where they are installed: lib/meltfront, with what they read at run time in
# share/meltfront two folders above it (cases/data_folder.h). In the build that is the source tree itself.
#   MELTFRONT_KERNELS  further levels of x86-64 that the library of the particle methods is compiled for, x86-64-v3 for
#                      instance, beside MELTFRONT_ARCHITECTURE. At the start of a program the C library's loader picks the
#                      highest level that the processor has.
set(MELTFRONT_KERNELS "" CACHE STRING "Further levels that the particle methods are compiled for, for instance x86-64-v3")
set(meltfront_library_folder lib/meltfront)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share)
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/share/meltfront SYMBOLIC)

# meltfront_shared_library(target [LEVEL level]): one of those that methods are made of or with, exported by its name
# without the prefix meltfront_.
function(meltfront_shared_library target)
  cmake_parse_arguments(ARG "" "LEVEL" "" ${ARGN})
  set(folder ${meltfront_library_folder})
  if(ARG_LEVEL)
    string(APPEND folder /glibc-hwcaps/${ARG_LEVEL})
  endif()
  string(REGEX REPLACE "^meltfront_" "" name ${target})
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${folder}
                        EXPORT_NAME ${name} INSTALL_RPATH "\$ORIGIN;\$ORIGIN/../..")
  # As fast as a static library: no function of it is to be replaced by another of the same name.
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  target_link_options(${target} PRIVATE LINKER:-Bsymbolic-functions LINKER:-z,defs)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:include/meltfront>)
  target_compile_features(${target} INTERFACE cxx_std_20)
  if(ARG_LEVEL)
    install(TARGETS ${target} LIBRARY DESTINATION ${folder})
  else()
    install(TARGETS ${target} EXPORT meltfrontTargets LIBRARY DESTINATION ${folder})
  endif()
endfunction()

# meltfront_harness_library(target): one of those that measure and record, static, for programs that link them.
function(meltfront_harness_library target)
  string(REGEX REPLACE "^meltfront_" "" name ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} INTERFACE cxx_std_20)
  install(TARGETS ${target} EXPORT meltfrontHarnessTargets ARCHIVE DESTINATION ${meltfront_library_folder})
endfunction()

# meltfront_kernels(target): the same library once more for every further level.
function(meltfront_kernels target)
  foreach(level IN LISTS MELTFRONT_KERNELS)
    get_target_property(sources ${target} SOURCES)
    get_target_property(options ${target} COMPILE_OPTIONS)
    get_target_property(libraries ${target} LINK_LIBRARIES)
    # CMake's own marks of where each was named
    list(FILTER libraries EXCLUDE REGEX "^::@")
    set(kernels ${target}_${level})
    add_library(${kernels} SHARED ${sources})
    target_link_libraries(${kernels} PRIVATE ${libraries})
    target_compile_options(${kernels} PRIVATE ${options} -march=${level})
    meltfront_shared_library(${kernels} LEVEL ${level})
    set_target_properties(${kernels} PROPERTIES OUTPUT_NAME ${target} UNITY_BUILD ${MELTFRONT_UNITY} UNITY_BUILD_MODE GROUP)
    add_dependencies(${target} ${kernels})
  endforeach()
endfunction()
