# SPDX-License-Identifier: Apache-2.0
# Linux, ARM with 64 bits and NEON, by the package g++-aarch64-linux-gnu of Debian.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Programs need no libraries of that processor, so that an emulator runs them.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(TETRALIGHT_HIGHWAY_HEADERS ON)
include(${CMAKE_CURRENT_LIST_DIR}/cross_headers.cmake)
