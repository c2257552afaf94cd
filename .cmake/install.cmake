# cmake --install: the program, its libraries, the headers, what is read at run time, what find_package(meltfront) reads, a
# manual page and what bash completes. All paths are relative to each other: the whole may be moved.
include(CMakePackageConfigHelpers)
include(.cmake/headers.cmake)

# Headers stand as they do here: #include <cases/method.h>
meltfront_headers(headers ${PROJECT_SOURCE_DIR} cases particles reference_fem verification/measure verification/record
                  verification/run)
foreach(header IN LISTS headers)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION include/meltfront/${folder})
endforeach()

# The hash of the headers that methods include: a plugin and the program that loads it must have the same.
set(plugin_interface ${PROJECT_BINARY_DIR}/include/cases/plugin_interface.h)
set(interface_headers ${headers})
list(FILTER interface_headers EXCLUDE REGEX "^verification/")
list(TRANSFORM interface_headers PREPEND ${PROJECT_SOURCE_DIR}/)
add_custom_command(OUTPUT ${plugin_interface} DEPENDS ${interface_headers} .cmake/plugin_interface.cmake .cmake/headers.cmake
  COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D VERSION=${PROJECT_VERSION} -D OUT=${plugin_interface}
          -P ${PROJECT_SOURCE_DIR}/.cmake/plugin_interface.cmake VERBATIM)
add_custom_target(meltfront_plugin_interface ALL DEPENDS ${plugin_interface})
install(FILES ${plugin_interface} DESTINATION include/meltfront/cases)
add_library(meltfront_plugin INTERFACE)
add_dependencies(meltfront_plugin meltfront_plugin_interface)
target_include_directories(meltfront_plugin INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
target_link_libraries(meltfront_plugin INTERFACE meltfront_cases)
set_target_properties(meltfront_plugin PROPERTIES EXPORT_NAME plugin)
install(TARGETS meltfront_plugin EXPORT meltfrontTargets)

install(EXPORT meltfrontTargets NAMESPACE meltfront:: DESTINATION lib/cmake/meltfront)
configure_package_config_file(.cmake/meltfrontConfig.cmake.in ${PROJECT_BINARY_DIR}/meltfrontConfig.cmake
                              INSTALL_DESTINATION lib/cmake/meltfront)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meltfrontConfigVersion.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/meltfrontConfig.cmake ${PROJECT_BINARY_DIR}/meltfrontConfigVersion.cmake
        DESTINATION lib/cmake/meltfront)
if(NOT MELTFRONT_WITH_DEALII)
  return()
endif()

meltfront_harness_library(meltfront_case_files)
meltfront_harness_library(meltfront_measure)
meltfront_harness_library(meltfront_record)
meltfront_harness_library(meltfront_run)
set_target_properties(meltfront_dealii PROPERTIES EXPORT_NAME dealii)
install(TARGETS meltfront_dealii EXPORT meltfrontHarnessTargets)
install(EXPORT meltfrontHarnessTargets NAMESPACE meltfront:: DESTINATION lib/cmake/meltfront)

set_target_properties(meltfront PROPERTIES INSTALL_RPATH "\$ORIGIN/../${meltfront_library_folder}")
install(TARGETS meltfront RUNTIME DESTINATION bin)
install(DIRECTORY cases/library cases/data DESTINATION share/meltfront/cases)
install(DIRECTORY verification/matrix/library DESTINATION share/meltfront/verification/matrix)
install(DIRECTORY verification/external/examples DESTINATION share/meltfront/verification/external)
install(FILES verification/external/protocol.schema.json DESTINATION share/meltfront/verification/external)
install(DIRECTORY verification/plugins/example DESTINATION share/meltfront/verification/plugins)
install(DIRECTORY results/reference DESTINATION share/meltfront/results)
# What the manual is made of
file(GLOB_RECURSE pages RELATIVE ${PROJECT_SOURCE_DIR} cases/*.md particles/*.md reference_fem/*.md verification/*.md)
foreach(page IN LISTS pages)
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${page} DESTINATION share/meltfront/${folder})
endforeach()
install(FILES LICENSE DESTINATION share/doc/meltfront RENAME copyright)
# The installed program writes these, which shows that it runs where it is.
install(CODE [[
  set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
  file(MAKE_DIRECTORY "${root}/share/man/man1" "${root}/share/bash-completion/completions")
  foreach(page "man=share/man/man1/meltfront.1" "bash=share/bash-completion/completions/meltfront")
    string(REGEX MATCH "^[^=]+" format "${page}")
    string(REGEX REPLACE "^[^=]+=" "" file "${page}")
    execute_process(COMMAND "${root}/bin/meltfront" manual --format ${format} --out "${root}/${file}"
                    COMMAND_ERROR_IS_FATAL ANY)
    message(STATUS "Installed by the program: ${root}/${file}")
  endforeach()
]])
include(.cmake/package.cmake)
