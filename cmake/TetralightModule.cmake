# SPDX-License-Identifier: Apache-2.0

# tetralight_options(TARGET): how all of our own code is compiled.
function(tetralight_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # No contraction: the same bytes from every compiler and processor of one instruction set.
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
    -ffp-contract=off)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(TETRALIGHT_SANITIZE)
    # GCC 12 sees uninitialized values in instrumented standard headers.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    target_compile_options(${target} PUBLIC
      -fsanitize=${TETRALIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${TETRALIGHT_SANITIZE})
  endif()
endfunction()

# Headers are included as <tetralight/FOLDER/header.h>, in the build tree as where they are installed:
# here through links to the source folders.
set(tetralight_include_dir ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${tetralight_include_dir}/tetralight)
foreach(folder base settings probes lppv runtime bake pipeline render server cli bench)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${tetralight_include_dir}/tetralight/${folder}
       COPY_ON_ERROR SYMBOLIC)
endforeach()

# tetralight_module(NAME SOURCES a.cpp... [PUBLIC lib...] [PRIVATE lib...]):
# a folder of the architecture as the library tetralight::NAME.
function(tetralight_module name)
  cmake_parse_arguments(module "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target tetralight_${name})
  add_library(${target} STATIC ${module_SOURCES})
  add_library(tetralight::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${tetralight_include_dir}> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} PUBLIC ${module_PUBLIC} PRIVATE ${module_PRIVATE})
  tetralight_options(${target})
endfunction()

# tetralight_ship(NAME): the module belongs to the ship set, which games may build without
# exceptions and RTTI.
function(tetralight_ship name)
  target_compile_options(tetralight_${name} PRIVATE -fno-exceptions -fno-rtti)
endfunction()
