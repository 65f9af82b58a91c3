# SPDX-License-Identifier: Apache-2.0
# Installs the ship set (libraries, headers, shaders, and the files by which CMake and pkg-config
# find them), the command, and the service. Each component is a Debian package
# (cmake/TetralightPackages.cmake).
include(CMakePackageConfigHelpers)

set(ship_modules base probes probes/delaunay probes/build lppv lightmap reflection runtime)
string(REPLACE "/" "_" ship_components "${ship_modules}")
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/tetralight)
set(shader_folder ${CMAKE_INSTALL_DATADIR}/tetralight/shaders)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tetralight)
# From the folder of the pkg-config files: Debian's own libraries lie one folder deeper than lib.
file(RELATIVE_PATH prefix_from_package /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)

foreach(module ${ship_modules})
  string(REPLACE "/" "_" target ${module})
  install(TARGETS tetralight_${target} EXPORT tetralight
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  # Public headers include headers of detail/. The other folders in a module, for example lppv/vdb,
  # are not part of the ship set.
  foreach(folder ${module} ${module}/detail)
    file(GLOB headers ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    install(FILES ${headers} DESTINATION ${header_folder}/${folder} COMPONENT dev)
  endforeach()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/runtime/shaders/ DESTINATION ${shader_folder}
        COMPONENT dev FILES_MATCHING PATTERN "*.glsl")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE COMPONENT dev
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libtetralight-dev RENAME copyright)

# The command. The programs behind --backend have other licences, so each is a component of its own.
if(TARGET tetralight_cli)
  install(TARGETS tetralight_cli RUNTIME COMPONENT program)
  foreach(program cgal tetgen)
    if(TARGET tetralight_${program})
      install(TARGETS tetralight_${program} RUNTIME COMPONENT ${program})
      install(FILES ${PROJECT_SOURCE_DIR}/packages/debian/tetralight-${program}.1 COMPONENT ${program}
              DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    endif()
  endforeach()
endif()

# The Python package, which loads the shared library of the system. Wheels have it inside (packages/python).
install(DIRECTORY ${PROJECT_SOURCE_DIR}/packages/python/src/tetralight OPTIONAL COMPONENT python EXCLUDE_FROM_ALL
        DESTINATION lib/python3/dist-packages
        FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN __pycache__ EXCLUDE)

# The service, and its page if it is built.
if(TARGET tetralight_cli AND TETRALIGHT_BUILD_SERVER)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/viewer/ OPTIONAL COMPONENT viewer
          DESTINATION ${CMAKE_INSTALL_DATADIR}/tetralight/viewer)
  # It names /usr/bin, so it is for packages.
  install(FILES ${PROJECT_SOURCE_DIR}/packages/systemd/tetralight.service COMPONENT server EXCLUDE_FROM_ALL
          DESTINATION lib/systemd/system)
endif()

# find_package(tetralight COMPONENTS ...)
find_package(hwy CONFIG QUIET)
install(EXPORT tetralight NAMESPACE tetralight:: FILE tetralightTargets.cmake
        DESTINATION ${package_folder} COMPONENT dev)
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/tetralightConfig.cmake.in
  ${PROJECT_BINARY_DIR}/tetralightConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS shader_folder)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetralightConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tetralightConfig.cmake
              ${PROJECT_BINARY_DIR}/tetralightConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT dev)

# The shared library: find_package(tetralight COMPONENTS shared), pkg-config tetralight-shared.
if(TARGET tetralight_shared)
  install(TARGETS tetralight_shared EXPORT tetralight_shared
          RUNTIME COMPONENT runtime
          LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(EXPORT tetralight_shared NAMESPACE tetralight:: FILE tetralightSharedTargets.cmake
          DESTINATION ${package_folder} COMPONENT dev)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/tetralight-shared.pc.in
                 ${PROJECT_BINARY_DIR}/tetralight-shared.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/tetralight-shared.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endif()

# pkg-config tetralight
set(ship_libraries ${ship_components})
list(REVERSE ship_libraries)
list(TRANSFORM ship_libraries PREPEND "-ltetralight_")
list(JOIN ship_libraries " " ship_libraries)
set(package_requires "")
if(hwy_FOUND)
  set(package_requires libhwy)
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/tetralight.pc.in ${PROJECT_BINARY_DIR}/tetralight.pc
               @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tetralight.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

include(TetralightPackages)
