# One INTERFACE target holds what every target of ours is compiled with.
add_library(reachlab_warnings INTERFACE)
target_compile_options(reachlab_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor> $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast>
  -Wno-maybe-uninitialized)  # g++ 12 reports its own AVX-512 intrinsics (GCC bug 105593)
# A product and a sum are two roundings wherever the code writes two operations: the compiler fuses none on its own, so that results do not
# hang on what it found to fuse (docs/adr/0020-fused-operations-are-written-out.md).
# Nor are operations that stand side by side put into one vector by itself: g++ 12 fuses a product with an alternating sum there (vfmaddsub)
# even so. Loops over lanes are another pass.
add_compile_options(-ffp-contract=off -fno-tree-slp-vectorize)
# Where vectors of three components are mostly copied it pays, a seventh of a tick, and nothing was fused: tests/house/fused.py looks into the
# programs for the one instruction that would tell.
set(REACHLAB_PAIRS -ftree-slp-vectorize)
set(REACHLAB_LEVEL_NUMBER 1)
if(REACHLAB_LEVEL MATCHES "^x86-64-v([234])$")
  set(REACHLAB_LEVEL_NUMBER ${CMAKE_MATCH_1})
  set(REACHLAB_LEVEL_NAME ${REACHLAB_LEVEL})
  add_compile_options(-march=${REACHLAB_LEVEL})
elseif(REACHLAB_LEVEL)
  message(FATAL_ERROR "REACHLAB_LEVEL is ${REACHLAB_LEVEL}; allowed: x86-64-v2, x86-64-v3, x86-64-v4, or nothing")
elseif(REACHLAB_NATIVE)
  set(REACHLAB_LEVEL_NAME native)
  add_compile_options(-march=native)
else()
  set(REACHLAB_LEVEL_NAME ${CMAKE_SYSTEM_PROCESSOR})
endif()
if(REACHLAB_SANITIZE)
  add_compile_options(-fsanitize=${REACHLAB_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${REACHLAB_SANITIZE})
endif()
# What a laboratory runs is hardened: fortified string functions, stack protector, full RELRO, control-flow protection where there is one.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fcf-protection REACHLAB_HAS_CF_PROTECTION)
if(REACHLAB_HARDENING AND NOT REACHLAB_SANITIZE)
  add_compile_options($<$<CONFIG:Release>:-fstack-protector-strong> $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=2>)
  if(REACHLAB_HAS_CF_PROTECTION)
    add_compile_options($<$<CONFIG:Release>:-fcf-protection>)
  endif()
  add_link_options($<$<CONFIG:Release>:LINKER:-z,relro,-z,now>)
  # What a tick runs through has canaries where there are buffers of characters, not at every Vec3: docs/adr/0027-canaries-off-the-tick.md.
  set(REACHLAB_TICK_HARDENING $<$<CONFIG:Release>:-fstack-protector> $<$<CONFIG:Release>:-fno-plt>)
endif()
find_program(REACHLAB_LLD ld.lld)
if(REACHLAB_LLD)
  add_link_options(-fuse-ld=lld)
endif()
find_program(REACHLAB_CCACHE ccache)
if(REACHLAB_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${REACHLAB_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${REACHLAB_CCACHE})
endif()

# reachlab_precompile(<target> <headers…>): large headers of libraries that most files of a target include are read once. Each file still
# includes what it uses. Sources that are compiled as one read them once anyway. A compiler cache does better, and precompiled headers would get
# in its way.
function(reachlab_precompile target)
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER AND NOT REACHLAB_UNITY)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# reachlab_unity(<target>): with REACHLAB_UNITY several sources are compiled as one, which spares time in a first build. Names in the unnamed
# namespaces of a target must then differ.
function(reachlab_unity target)
  if(REACHLAB_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 40)
    # By default g++ collects its garbage from 128 MB on, again and again while it compiles forty sources. That is a seventh of its time.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1000000>)
  endif()
endfunction()

# What computes little is compiled so. It takes three quarters of the compile time of -O1, and -O0 takes no less.
set(REACHLAB_QUICK -Og)
# The option of sources whose speed counts in a library that is compiled quickly.
set(REACHLAB_COMPUTES $<$<CONFIG:RelWithDebInfo>:-O2>)

# reachlab_compile_quickly(<target>): nobody waits for what it computes, so a dev build spends half the time on it. A release is unchanged.
function(reachlab_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:${REACHLAB_QUICK}>)
endfunction()

# reachlab_compile_apart(<target> <option> <sources…>): these sources of a target get one more option. They become an object library, because CMake
# leaves a source with further options out of a unity build. The call copies the target's options, so it comes after them.
function(reachlab_compile_apart target option)
  set(apart ${target}_apart)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  get_target_property(others ${target} SOURCES)
  list(REMOVE_ITEM others ${sources})
  set_property(TARGET ${target} PROPERTY SOURCES ${others} $<TARGET_OBJECTS:${apart}>)
  add_library(${apart} OBJECT ${sources})
  reachlab_unity(${apart})
  foreach(property INCLUDE_DIRECTORIES LINK_LIBRARIES COMPILE_OPTIONS)
    get_target_property(value ${target} ${property})
    if(value)
      set_property(TARGET ${apart} PROPERTY ${property} ${value})
    endif()
  endforeach()
  target_compile_options(${apart} PRIVATE ${option})
endfunction()

# reachlab_library(<name> [COMPUTES] DEPENDS <public libraries…> PRIVATE <private libraries…> ROOMS <sub-folders…>): the .cpp files of this folder and
# of its rooms as one target. COMPUTES says that its speed counts in a dev build too.
function(reachlab_library name)
  cmake_parse_arguments(ARG "COMPUTES" "" "DEPENDS;PRIVATE;ROOMS" ${ARGN})
  set(patterns ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(room IN LISTS ARG_ROOMS)
    list(APPEND patterns ${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE} reachlab_warnings)
  reachlab_unity(${name})
  if(NOT ARG_COMPUTES)
    reachlab_compile_quickly(${name})
  endif()
endfunction()

# reachlab_test(<folder> <libraries…>): tests/<folder>/*_test.cpp as one GoogleTest program, each test known to ctest.
function(reachlab_test folder)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${folder} ${sources})
  reachlab_unity(test_${folder})
  target_link_libraries(test_${folder} PRIVATE ${ARGN} GTest::gtest GTest::gtest_main reachlab_warnings)
  target_include_directories(test_${folder} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/tests)
  target_compile_options(test_${folder} PRIVATE ${REACHLAB_QUICK})  # what a test itself computes is short
  reachlab_precompile(test_${folder} <gtest/gtest.h> <algorithm> <cmath> <filesystem> <fstream> <functional> <map> <optional> <random> <string>
    <vector>)
  gtest_discover_tests(test_${folder} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
