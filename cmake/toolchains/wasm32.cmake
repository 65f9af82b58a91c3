# SPDX-License-Identifier: Apache-2.0
# WebAssembly with 128-bit vectors and without WASI, by the packages clang-16, lld-16, llvm-16,
# wasi-libc, libc++-16-dev-wasm32, libc++abi-16-dev-wasm32 and libclang-rt-16-dev-wasm32 of Debian.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-16)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-16)
set(CMAKE_RANLIB llvm-ranlib-16)
set(CMAKE_CXX_FLAGS_INIT "-msimd128")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
# A module without main().
set(CMAKE_EXE_LINKER_FLAGS_INIT "-mexec-model=reactor")
set(TETRALIGHT_HIGHWAY_HEADERS ON)
include(${CMAKE_CURRENT_LIST_DIR}/cross_headers.cmake)
