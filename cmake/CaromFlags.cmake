# The flags of every target of the project, tests and benchmarks included: directory properties, so
# that no target can be without them.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CAROM_CCACHE ccache)
mark_as_advanced(CAROM_CCACHE)
if(CAROM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Clones in different directories share what they have compiled, with precompiled headers as well.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${CAROM_CCACHE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)
  else()
    add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
  endif()
endif()

# Bit equality: no contraction to FMA, and no SLP vectorisation, under which g++ 12 drops the
# rounding of double -> float -> double.
set(CAROM_MATH_FLAGS -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math)
# g++ 12 copies structs of vectors in pieces of 16 bytes, which stall the loads behind them (linear
# times of impact on AVX2: capsule-box 215 to 127 ns, sphere-sphere 21 to 14).
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-mmove-max=512 CAROM_HAS_MOVE_MAX)
set(CAROM_COPY_FLAGS)
if(CAROM_HAS_MOVE_MAX)
  set(CAROM_COPY_FLAGS -mmove-max=512)
endif()
# Static and shared libraries are made of the same objects. Exported functions are not replaced by
# others, so that they may be inlined.
add_compile_options(-fno-semantic-interposition)
add_compile_options(${CAROM_MATH_FLAGS} ${CAROM_COPY_FLAGS} -Wall -Wextra -Wshadow -Wpedantic)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees overlapping copies inside std::string where there are none (GCC bug 105651), and where
  # the standard library is precompiled copies beyond its ends as well.
  add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  # Highway's NEON functions have the target +crypto, which g++ does not give to the implicit
  # members of classes: it would refuse to inline. Nothing here calls a cryptographic instruction.
  add_compile_options(-march=armv8-a+crypto)
endif()
# Headers that CMake writes are beside those of the sources.
include_directories(${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include
                    ${PROJECT_BINARY_DIR}/generated)
if(CAROM_SCALAR_ONLY)
  add_compile_definitions(HWY_COMPILE_ONLY_SCALAR)
else()
  # The emulated scalar target beside those of the machine.
  add_compile_definitions(HWY_COMPILE_ALL_ATTAINABLE)
endif()
if(CAROM_FEW_TARGETS)
  add_compile_definitions(CAROM_FEW_TARGETS)
endif()
if(CAROM_SANITIZE)
  add_compile_options(-fsanitize=${CAROM_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  # With the folder of the build in what a debugger reads, no other clone could use the object file.
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
  add_link_options(-fsanitize=${CAROM_SANITIZE})
  # Without it each number of a vector costs calls, each with its checks.
  add_compile_definitions("EIGEN_STRONG_INLINE=__attribute__((always_inline)) inline")
endif()
