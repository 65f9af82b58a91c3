# SPDX-License-Identifier: Apache-2.0
# Debian packages by `cpack -G DEB`: one for each component of TetralightInstall.cmake, or those that
# CPACK_COMPONENTS_ALL names. `./run package debian` builds them (docs/install.md).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tetralight)
set(CPACK_PACKAGE_VENDOR Tetralight)
set(CPACK_PACKAGE_CONTACT "Tetralight contributors <maintainers@tetralight.invalid>")
# Each package has a summary of its own. CPack puts no other before it if this one is its default.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(debian ${PROJECT_SOURCE_DIR}/packages/debian)

# debian_package(COMPONENT NAME SECTION DESCRIPTION [FIELD VALUE]...): FIELD is a variable of CPack
# without CPACK_DEBIAN_<COMPONENT>_, for example PACKAGE_DEPENDS.
set(CPACK_COMPONENTS_ALL "")
set(CPACK_TETRALIGHT_PACKAGES "")
macro(debian_package component name section description)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  list(APPEND CPACK_TETRALIGHT_PACKAGES ${component}=${name})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${description}")
  set(fields "${ARGN}")
  while(fields)
    list(POP_FRONT fields field value)
    set(CPACK_DEBIAN_${upper}_${field} "${value}")
  endwhile()
endmacro()

set(dev_depends libglm-dev)
if(hwy_FOUND)
  string(APPEND dev_depends ", libhwy-dev")
endif()
if(TARGET tetralight_shared)
  # dpkg runs ldconfig by a trigger; packages that link the library depend on it by shlibs.
  configure_file(${debian}/runtime/shlibs.in ${PROJECT_BINARY_DIR}/debian_runtime/shlibs @ONLY)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
      ${PROJECT_BINARY_DIR}/debian_runtime/shlibs ${debian}/runtime/triggers)
  debian_package(runtime libtetralight0 libs "Baked light probes at run time, as a shared library
The C API of Tetralight, for programs in any language that locate, interpolate
and shade with the light probes of .probes files.")
  set(this_library "libtetralight0 (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
  string(PREPEND dev_depends "${this_library}, ")
  if(EXISTS ${PROJECT_SOURCE_DIR}/packages/python/src/tetralight)
    debian_package(python python3-tetralight python "Baked light probes in Python, with NumPy
The module tetralight opens .probes files, answers millions of queries on all
processors, relights, and shows probes. It runs the command to bake."
      PACKAGE_ARCHITECTURE all
      PACKAGE_DEPENDS "${this_library}, python3, python3-numpy"
      PACKAGE_RECOMMENDS tetralight)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${debian}/python/postinst ${debian}/python/prerm)
  endif()
endif()
debian_package(dev libtetralight-dev libdevel "Baked light probes at run time, for programs that are built
Libraries, headers and shaders that locate, interpolate and shade with the
light probes of .probes files, for C++20, C99, GLSL and HLSL."
  PACKAGE_DEPENDS "${dev_depends}")

if(TARGET tetralight_cli)
  debian_package(program tetralight graphics "Bake the light of scenes into probes, lightmaps and reflections
The command tetralight reads glTF scenes, path-traces the light at light
probes, joins them in a Delaunay tetrahedralization, and answers which light
arrives at any position. It renders pictures, writes the formats of game
engines, and serves scenes, bakes and queries over HTTP."
    PACKAGE_SUGGESTS "tetralight-cgal, tetralight-server, tetralight-tetgen")
  if(TARGET tetralight_cgal)
    debian_package(cgal tetralight-cgal graphics "CGAL as a backend of tetralight
The program that tetralight tetrahedralize runs with --backend cgal. It is
linked with CGAL, and so its licence is GPL-3.0-or-later."
      PACKAGE_ENHANCES tetralight)
  endif()
  if(TARGET tetralight_tetgen)
    debian_package(tetgen tetralight-tetgen graphics "TetGen as a backend of tetralight
The program that tetralight tetrahedralize runs with --backend tetgen. It is
linked with TetGen, and so its licence is AGPL-3.0-or-later."
      PACKAGE_ENHANCES tetralight)
  endif()
endif()
if(TARGET tetralight_cli AND TETRALIGHT_BUILD_SERVER)
  debian_package(server tetralight-server net "Tetralight as a service of systemd
A unit that runs tetralight serve as a user of its own, in a sandbox. It is
neither enabled nor started when it is installed."
    PACKAGE_ARCHITECTURE all
    PACKAGE_DEPENDS "tetralight (>= ${PROJECT_VERSION})"
    PACKAGE_RECOMMENDS tetralight-viewer)
  set(CPACK_DEBIAN_SERVER_PACKAGE_CONTROL_EXTRA
      ${debian}/server/conffiles ${debian}/server/postinst ${debian}/server/prerm ${debian}/server/postrm)
  if(EXISTS ${PROJECT_SOURCE_DIR}/build/viewer/index.html)
    debian_package(viewer tetralight-viewer web "Page of the Tetralight service
The web page that tetralight serve shows: scenes lit by their probes, cells,
error bars, probe groups to edit, and bakes with their progress."
      PACKAGE_ARCHITECTURE all
      PACKAGE_ENHANCES tetralight-server)
  endif()
endif()

# Copyright, changelog and a bill of materials of each package; compressed pages.
find_package(Python3 COMPONENTS Interpreter QUIET)
set(CPACK_TETRALIGHT_SOURCES ${PROJECT_SOURCE_DIR})
set(CPACK_TETRALIGHT_PYTHON ${Python3_EXECUTABLE})
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/finish_packages.cmake)
include(CPack)
