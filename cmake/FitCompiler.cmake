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

set(GARMENTFIT_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined or thread")

function(fit_target name)
    target_compile_options(${name} PRIVATE -Wall -Wextra -Wshadow -Wno-psabi
                           # exact predicates and equal bits on every machine need plain IEEE arithmetic
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
