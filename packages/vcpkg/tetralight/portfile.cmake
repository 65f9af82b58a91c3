# SPDX-License-Identifier: Apache-2.0
# The ship set from the sources around this port: vcpkg install tetralight --overlay-ports=packages/vcpkg
# Untried: written from vcpkg's documentation, without a run of it (docs/install.md).
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
vcpkg_check_linkage(ONLY_STATIC_LIBRARY)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DTETRALIGHT_BUILD_OFFLINE=OFF
    -DTETRALIGHT_BUILD_SHARED=OFF
    -DTETRALIGHT_BUILD_TESTS=OFF
    -DTETRALIGHT_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/tetralight)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share"
     "${CURRENT_PACKAGES_DIR}/share/doc")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
