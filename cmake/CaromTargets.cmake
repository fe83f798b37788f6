# carom_glob(OUT PATTERN...): the files of this folder and those below it that match; new files are
# picked up by the next build.
function(carom_glob out)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${ARGN})
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# carom_add_precompiled(NAME HEADER...): headers compiled once for all targets that say
# target_precompile_headers(TARGET REUSE_FROM NAME) and have the flags of this folder. Every file
# still includes what it uses: builds with clang-tidy and for AArch64 have none of this.
function(carom_add_precompiled name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cc)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen)
  target_precompile_headers(${name} PRIVATE
    <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory> <optional>
    <span> <string> <type_traits> <utility> <variant> <vector> ${ARGN})
endfunction()

# carom_add_objects(NAME): the sources of this folder and those below it as an object library.
function(carom_add_objects name)
  carom_glob(sources *.cc)
  add_library(${name} OBJECT ${sources})
  target_link_libraries(${name} PRIVATE hwy::hwy TBB::tbb Eigen3::Eigen)
  target_precompile_headers(${name} REUSE_FROM carom_precompiled)
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
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(BUILD_SHARED_LIBS)
    add_library(${name}_core STATIC EXCLUDE_FROM_ALL ${objects})
    target_link_libraries(${name}_core PUBLIC hwy::hwy TBB::tbb Eigen3::Eigen)
  else()
    target_compile_definitions(${name} PUBLIC CAROM_STATIC)
    add_library(${name}_core ALIAS ${name})
  endif()
endfunction()

# carom_add_test(NAME SOURCES file... [LIBS target...]): a GoogleTest executable, each of whose
# tests is a test of ctest.
function(carom_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBS")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE carom_test_support ${arg_LIBS} GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM carom_precompiled_tests)
  target_compile_definitions(${name} PRIVATE
    CAROM_TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
    CAROM_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  set(timeout 300)
  if(CAROM_SANITIZE)
    target_compile_definitions(${name} PRIVATE CAROM_TEST_SANITIZED)
    set(timeout 1200)
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${timeout})
endfunction()
