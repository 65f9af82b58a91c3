# SPDX-License-Identifier: Apache-2.0
# For toolchain files of other platforms: GLM and xxHash are headers without a platform, so that those
# of this system serve. Only these are linked into a folder, as a cross compiler must not read the
# others of /usr/include. Highway's library is compiled for this system, so that the scalar twin does
# the work; where TETRALIGHT_HIGHWAY_HEADERS is set, the compiler's processor is the only one that
# vector code is compiled for, which needs Highway's headers alone.
set(TETRALIGHT_HEADERS_FROM /usr/include CACHE PATH "Folder with glm/ and xxhash.h")
set(cross_headers ${CMAKE_BINARY_DIR}/cross_headers)
file(MAKE_DIRECTORY ${cross_headers}/cmake)
foreach(name glm xxhash.h)
  file(CREATE_LINK ${TETRALIGHT_HEADERS_FROM}/${name} ${cross_headers}/${name} SYMBOLIC)
endforeach()
file(CONFIGURE OUTPUT ${cross_headers}/cmake/glmConfig.cmake CONTENT
"if(NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
  set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${cross_headers})
endif()
")
set(glm_DIR ${cross_headers}/cmake CACHE PATH "")
set(XXHASH_INCLUDE_DIR ${cross_headers} CACHE PATH "")
if(TETRALIGHT_HIGHWAY_HEADERS)
  file(CREATE_LINK ${TETRALIGHT_HEADERS_FROM}/hwy ${cross_headers}/hwy SYMBOLIC)
  file(CONFIGURE OUTPUT ${cross_headers}/cmake/hwyConfig.cmake CONTENT
"if(NOT TARGET hwy::hwy)
  add_library(hwy::hwy INTERFACE IMPORTED)
  set_target_properties(hwy::hwy PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${cross_headers}
    INTERFACE_COMPILE_DEFINITIONS HWY_COMPILE_ONLY_STATIC)
endif()
")
  set(hwy_DIR ${cross_headers}/cmake CACHE PATH "")
else()
  set(CMAKE_DISABLE_FIND_PACKAGE_hwy ON CACHE BOOL "")
endif()

# Libraries of this system are not those of the other one.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
