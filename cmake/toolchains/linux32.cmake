# SPDX-License-Identifier: Apache-2.0
# Linux, x86 with 32 bits, by the packages g++ and g++-12-multilib of Debian. Programs run on x86-64.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(CMAKE_CXX_COMPILER g++-12)
# The package gcc-multilib, which conflicts with cross compilers, would add a link to these headers.
set(asm_headers ${CMAKE_BINARY_DIR}/asm_headers)
file(MAKE_DIRECTORY ${asm_headers})
file(CREATE_LINK /usr/include/x86_64-linux-gnu/asm ${asm_headers}/asm SYMBOLIC)
# With the x87 floating-point unit, answers would depend on which values the compiler keeps in registers.
set(CMAKE_CXX_FLAGS_INIT "-m32 -msse2 -mfpmath=sse -D_FILE_OFFSET_BITS=64 -idirafter ${asm_headers}")
include(${CMAKE_CURRENT_LIST_DIR}/cross_headers.cmake)
