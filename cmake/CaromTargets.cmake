# carom_glob(OUT PATTERN...): the files of this folder and those below it that match; new files are
# picked up by the next build.
function(carom_glob out)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${ARGN})
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# carom_add_precompiled(NAME HEADER...): headers compiled once for all targets that say
# target_precompile_headers(TARGET REUSE_FROM NAME) and have the flags of this folder. Every file
# still includes what it uses: the check for AArch64 precompiles nothing but Eigen.
function(carom_add_precompiled name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cc)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen)
  target_precompile_headers(${name} PRIVATE
    <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory> <optional>
    <span> <string> <type_traits> <utility> <variant> <vector> ${ARGN})
endfunction()

# carom_compile_together(TARGET [ALONE file...]): compiles the sources of a folder in groups of at most
# eight, so that the headers that they share are read once a group (with CAROM_UNITY_BUILD). Files that
# are compiled once for every instruction set are in groups of their own. ALONE: files that take long,
# or that are slower in a group. Files with settings of their own stay alone as well.
function(carom_compile_together target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ALONE")
  list(TRANSFORM arg_ALONE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  get_target_property(sources ${target} SOURCES)
  set(last_folder "")
  set(kernels "")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    file(STRINGS ${source} targets REGEX "foreach_target.h")
    if(definitions OR targets OR source IN_LIST arg_ALONE)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      if(targets AND NOT definitions AND NOT source IN_LIST arg_ALONE)
        list(APPEND kernels ${source})
      endif()
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    if(NOT folder STREQUAL last_folder)
      set(last_folder ${folder})
      set(count 0)
    endif()
    math(EXPR group "${count} / 8")
    math(EXPR count "${count} + 1")
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
    string(REPLACE "/" "_" name "${name}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name}_${group})
  endforeach()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${CAROM_UNITY_BUILD} UNITY_BUILD_MODE GROUP)
  if(CAROM_UNITY_BUILD)
    carom_compile_kernels_together(${target} ${kernels})
  endif()
endfunction()

# carom_compile_kernels_together(TARGET FILE...): compiles files that are compiled once for every
# instruction set in groups of three, so that Highway and the loops around kernels are read once a
# group. The file of a group goes through the instruction sets; its members then find that done.
function(carom_compile_kernels_together target)
  set(group 0)
  set(files ${ARGN})
  while(files)
    list(POP_FRONT files first second third)
    set(members ${first} ${second} ${third})
    set(name kernels/${target}_${group}.cc)
    set(itself "#undef HWY_TARGET_INCLUDE\n#define HWY_TARGET_INCLUDE \"${name}\"\n")
    set(text "// Written by CMake.\n#include \"simd/targets.h\"\n\n${itself}")
    string(APPEND text "#include <hwy/foreach_target.h>\n\n")
    foreach(member IN LISTS members)
      cmake_path(RELATIVE_PATH member BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE path)
      string(APPEND text "#include \"${path}\"\n")
    endforeach()
    string(APPEND text "\n// Each of them has named itself.\n${itself}")
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${name} CONTENT "${text}" @ONLY)
    set_source_files_properties(${members} PROPERTIES HEADER_FILE_ONLY ON)
    target_sources(${target} PRIVATE ${PROJECT_BINARY_DIR}/generated/${name})
    set_source_files_properties(${PROJECT_BINARY_DIR}/generated/${name} PROPERTIES
      SKIP_UNITY_BUILD_INCLUSION ON)
    math(EXPR group "${group} + 1")
  endwhile()
endfunction()

# carom_add_objects(NAME [SOURCES file... | EXCLUDE file...] [ALONE file...]): these sources, or those of
# this folder and below it, as an object library.
function(carom_add_objects name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;EXCLUDE;ALONE")
  set(sources ${arg_SOURCES})
  if(NOT sources)
    carom_glob(sources *.cc)
    list(TRANSFORM arg_EXCLUDE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    list(REMOVE_ITEM sources ${arg_EXCLUDE})
  endif()
  add_library(${name} OBJECT ${sources})
  target_link_libraries(${name} PRIVATE hwy::hwy TBB::tbb Eigen3::Eigen)
  target_precompile_headers(${name} REUSE_FROM carom_precompiled)
  carom_compile_together(${name} ALONE ${arg_ALONE})
endfunction()

# carom_add_product(NAME OBJECT_LIBRARY...): the installed library NAME, and NAME_core, the same
# objects as a static library for the program, tests and benchmarks, which use private symbols.
function(carom_add_product name)
  list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_library(${name} ${objects})
  string(REPLACE carom_ "" export_name ${name})
  add_library(carom::${export_name} ALIAS ${name})
  set_target_properties(${name} PROPERTIES
    EXPORT_NAME ${export_name} VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    INSTALL_RPATH $ORIGIN)  # a library finds those beside it
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(BUILD_SHARED_LIBS)
    add_library(${name}_core STATIC EXCLUDE_FROM_ALL ${objects})
    target_link_libraries(${name}_core PUBLIC hwy::hwy TBB::tbb Eigen3::Eigen)
  else()
    target_compile_definitions(${name} INTERFACE $<INSTALL_INTERFACE:CAROM_STATIC>)
    add_library(${name}_core ALIAS ${name})
  endif()
endfunction()

# carom_add_test(NAME SOURCES file... [LIBS target...] [COST number]): a GoogleTest executable, each
# of whose tests is a test of ctest. Tests of higher cost start earlier.
function(carom_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "COST" "SOURCES;LIBS")
  if(NOT arg_COST)
    set(arg_COST 1)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE carom_test_support ${arg_LIBS} GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM carom_precompiled_tests)
  carom_compile_together(${name})
  target_compile_definitions(${name} PRIVATE
    CAROM_TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
    CAROM_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  set(timeout 300)
  if(CAROM_SANITIZE)
    target_compile_definitions(${name} PRIVATE CAROM_TEST_SANITIZED)
    set(timeout 1200)
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${timeout} COST ${arg_COST})
endfunction()
