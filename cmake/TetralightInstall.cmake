# SPDX-License-Identifier: Apache-2.0
# Installs the ship set (libraries, headers, shaders, and the files by which CMake and pkg-config
# find them) and the command. CPack makes a Debian package of the ship set (docs/embed.md).
include(CMakePackageConfigHelpers)

set(ship_modules base probes probes/delaunay probes/build lppv lightmap reflection runtime)
string(REPLACE "/" "_" ship_components "${ship_modules}")
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/tetralight)
set(shader_folder ${CMAKE_INSTALL_DATADIR}/tetralight/shaders)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tetralight)

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

# The command, and the page of `tetralight serve` if it is built.
if(TARGET tetralight_cli)
  install(TARGETS tetralight_cli RUNTIME COMPONENT program)
  foreach(program tetralight_cgal tetralight_tetgen)
    if(TARGET ${program})
      install(TARGETS ${program} RUNTIME COMPONENT program)
    endif()
  endforeach()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/viewer/ OPTIONAL COMPONENT program
          DESTINATION ${CMAKE_INSTALL_DATADIR}/tetralight/viewer)
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

# cpack -G DEB
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tetralight)
set(CPACK_PACKAGE_CONTACT "Tetralight contributors <tetralight@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libtetralight-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Baked light probes at run time
 Libraries, headers and shaders that locate, interpolate and shade with the
 light probes of .probes files, for C++20, C99, GLSL and HLSL.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS libglm-dev)
if(hwy_FOUND)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libhwy-dev")
endif()
include(CPack)
