# Flags that every target of the project shares. Call fit_target(name) once per target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# All targets alike: objects of both kinds in one library would share code that only one kind of processor runs.
set(GARMENTFIT_CPU auto CACHE STRING
    "Processors to build for: baseline, x86-64-v3 (those with AVX2 and FMA), or auto: this machine's of these two")
set_property(CACHE GARMENTFIT_CPU PROPERTY STRINGS auto baseline x86-64-v3)
if(NOT GARMENTFIT_CPU MATCHES "^(auto|baseline|x86-64-v3)$")
    message(FATAL_ERROR "GARMENTFIT_CPU: \"${GARMENTFIT_CPU}\" is none of auto, baseline, x86-64-v3")
endif()
set(fit_cpu ${GARMENTFIT_CPU})
if(GARMENTFIT_INSTALLED)
    set(fit_cpu baseline)  # the installed libfit, not the plugins on it, is what takes the time
elseif(fit_cpu STREQUAL auto)
    set(fit_cpu baseline)
    if(NOT CMAKE_CROSSCOMPILING)
        include(CheckCXXSourceRuns)
        check_cxx_source_runs("int main() { return !(__builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\")
                                                     && __builtin_cpu_supports(\"bmi2\")); }" GARMENTFIT_HAS_X86_64_V3)
        if(GARMENTFIT_HAS_X86_64_V3)
            set(fit_cpu x86-64-v3)
        endif()
    endif()
endif()
set(GARMENTFIT_X86_64_V3 0)
if(fit_cpu STREQUAL x86-64-v3)
    set(GARMENTFIT_X86_64_V3 1)
    # GCC 12 is mistaken about loops of four doubles that never run over vectors of three (Eigen's umeyama); baseline
    # builds keep the warnings
    add_compile_options(-march=x86-64-v3 -Wno-array-bounds -Wno-free-nonheap-object)
    # Matrices of libfit and of programs that are compiled for other processors: aligned to what all have, and kept in
    # memory that Eigen aligns by itself in both (else it would be malloc's in the one and its own in the other).
    set(fit_eigen_memory EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=0)
    add_compile_definitions(${fit_eigen_memory})
endif()

set(GARMENTFIT_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined or thread")

function(fit_target name)
    target_compile_options(${name} PRIVATE -Wall -Wextra -Wshadow -Wno-psabi
                           # exact predicates need plain IEEE arithmetic
                           -ffp-contract=off)
    if(GARMENTFIT_WERROR)
        target_compile_options(${name} PRIVATE -Werror)
    endif()
    if(GARMENTFIT_SANITIZE)
        target_compile_options(${name} PRIVATE -fsanitize=${GARMENTFIT_SANITIZE} -fno-omit-frame-pointer)
        target_link_options(${name} PRIVATE -fsanitize=${GARMENTFIT_SANITIZE})
    endif()
endfunction()

# fit_precompiled(NAME [EXECUTABLES] LIBRARIES TARGET... [HEADERS <HEADER>...])
# Precompiles what most sources include, for libraries (or executables) that are compiled with the flags of these
# libraries.
function(fit_precompiled name)
    if(NOT GARMENTFIT_PCH)
        return()
    endif()
    cmake_parse_arguments(PARSE_ARGV 1 pch "EXECUTABLES" "" "LIBRARIES;HEADERS")
    set(empty ${CMAKE_CURRENT_BINARY_DIR}/precompiled_${name}.cpp)  # a target has a source
    file(CONFIGURE OUTPUT ${empty} CONTENT "")
    add_library(garmentfit_precompiled_${name} OBJECT ${empty})
    fit_target(garmentfit_precompiled_${name})
    target_link_libraries(garmentfit_precompiled_${name} PRIVATE ${pch_LIBRARIES})
    if(pch_EXECUTABLES)  # of objects, which CMake would compile with -fPIC, for sources that it compiles with -fPIE
        set_target_properties(garmentfit_precompiled_${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
        target_compile_options(garmentfit_precompiled_${name} PRIVATE -fPIE)
    endif()
    target_precompile_headers(garmentfit_precompiled_${name} PRIVATE
        <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <numeric> <optional> <string> <string_view>
        <utility> <vector> <Eigen/Core> <Eigen/Geometry> ${pch_HEADERS})
endfunction()

function(fit_use_precompiled target name)
    if(GARMENTFIT_PCH)
        target_precompile_headers(${target} REUSE_FROM garmentfit_precompiled_${name})
    endif()
endfunction()
