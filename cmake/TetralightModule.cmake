# SPDX-License-Identifier: Apache-2.0
include(GNUInstallDirs)

# Queries, bakes and tests are several times slower without optimization. Builds of Tetralight itself
# and of projects that add it as a subdirectory often have an empty CMAKE_BUILD_TYPE by mistake.
function(tetralight_warn_without_optimization)
  get_property(has_configurations GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(has_configurations)
    return()
  endif()
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  get_directory_property(directory_options COMPILE_OPTIONS)
  set(flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${directory_options}")
  if(NOT flags MATCHES "[-/]O")
    message(WARNING "Tetralight is built without optimization (CMAKE_BUILD_TYPE is "
      "\"${CMAKE_BUILD_TYPE}\" and no flag contains -O): queries are several times slower. "
      "Set CMAKE_BUILD_TYPE to Release or RelWithDebInfo.")
  endif()
endfunction()

# tetralight_options(TARGET): the compiler options of all our own code.
function(tetralight_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # Without contraction of floating-point operations every compiler gives the same bytes.
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
    -ffp-contract=off)
  # GCC 12 takes std::string operations for overlapping copies (its bug 105651).
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
  if(TETRALIGHT_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(TETRALIGHT_SANITIZE)
    # GCC 12 reports uninitialized values in instrumented standard headers.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    target_compile_options(${target} PUBLIC
      -fsanitize=${TETRALIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${TETRALIGHT_SANITIZE})
  endif()
endfunction()

# Headers are included as <tetralight/FOLDER/header.h> in the build tree and in the install tree. In
# the build tree these paths are links to the source folders.
set(tetralight_include_dir ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${tetralight_include_dir}/tetralight)
foreach(folder base probes charts lppv lightmap reflection runtime bake imports engines pipeline settings batch render server
               cli bench)
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${folder})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${tetralight_include_dir}/tetralight/${folder}
         COPY_ON_ERROR SYMBOLIC)
  endif()
endforeach()

# tetralight_module(NAME SOURCES a.cpp... [PUBLIC lib...] [PRIVATE lib...]):
# the library tetralight::NAME from one folder of docs/architecture.md.
function(tetralight_module name)
  cmake_parse_arguments(module "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target tetralight_${name})
  add_library(${target} STATIC ${module_SOURCES})
  add_library(tetralight::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${tetralight_include_dir}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${module_PUBLIC} PRIVATE ${module_PRIVATE})
  tetralight_options(${target})
endfunction()

# tetralight_compile_alone(FILE...): sources that are not combined with others in unity builds, which
# the release preset makes: they define macros or names that others must not see.
function(tetralight_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# tetralight_use_highway(TARGET [SOURCE...]): if Highway is found, adds sources of vector code, which is
# compiled for each kind of processor and chosen at run time. Not for SVE and RVV, whose vectors cannot
# be members of structs: such processors use the code for NEON or the scalar twin.
function(tetralight_use_highway target)
  find_package(hwy CONFIG QUIET)
  if(NOT hwy_FOUND)
    return()
  endif()
  foreach(source ${ARGN})
    target_sources(${target} PRIVATE ${source})
    tetralight_compile_alone(${source})
  endforeach()
  target_compile_definitions(${target} PRIVATE TETRALIGHT_HAS_HIGHWAY
    "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV)")
  target_link_libraries(${target} PRIVATE hwy::hwy)
endfunction()

# tetralight_ship(NAME): the module belongs to the ship set, which is built without exceptions and
# RTTI so that a game can be built without them.
#
# Its symbols are hidden and in sections of their own: the shared library exports the C API alone and
# leaves out what that does not need (runtime/shared).
function(tetralight_ship name)
  set_target_properties(tetralight_${name} PROPERTIES
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(tetralight_${name} PRIVATE
    -fno-exceptions -ffunction-sections -fdata-sections)
  # UBSan checks objects by their type information, also of those that this module makes.
  if(NOT TETRALIGHT_SANITIZE)
    target_compile_options(tetralight_${name} PRIVATE -fno-rtti)
  endif()
endfunction()
