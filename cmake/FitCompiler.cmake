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
