# SPDX-License-Identifier: Apache-2.0
# Run by CPack when the files of all packages lie in their folders, before it packs them.
foreach(package ${CPACK_TETRALIGHT_PACKAGES})
  string(REPLACE "=" ";" package ${package})
  list(GET package 0 component)
  list(GET package 1 name)
  if(NOT IS_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/${component})
    continue()
  endif()
  execute_process(
    COMMAND ${CPACK_TETRALIGHT_PYTHON} ${CPACK_TETRALIGHT_SOURCES}/packages/debian/finish_package.py
      ${name} ${CPACK_TEMPORARY_DIRECTORY}/${component}
      --version ${CPACK_PACKAGE_VERSION} --release ${CPACK_DEBIAN_PACKAGE_RELEASE}
      --contact ${CPACK_PACKAGE_CONTACT}
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
