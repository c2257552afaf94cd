# Names the headers that a plugin is compiled with: cmake -D SOURCE=... -D VERSION=... -D OUT=... -P plugin_interface.cmake
include(${CMAKE_CURRENT_LIST_DIR}/headers.cmake)
meltfront_headers(headers ${SOURCE} cases particles reference_fem)
set(hashes)
foreach(header IN LISTS headers)
  file(SHA256 ${SOURCE}/${header} hash)
  string(APPEND hashes "${header} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 12 hash)
file(CONFIGURE OUTPUT ${OUT} CONTENT
"/* Made by .cmake/plugin_interface.cmake: the version, and a hash of all headers that a method may include. */
#define MELTFRONT_HEADERS \"meltfront ${VERSION}, headers ${hash}\"
")
