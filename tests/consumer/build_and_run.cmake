# Installs the build tree into a fresh prefix, builds the consumer against it, runs it with ARGUMENTS, if any.
foreach(name BUILD_DIR SOURCE_DIR WORK_DIR)
    if(NOT ${name})
        message(FATAL_ERROR "${name} is not set")
    endif()
endforeach()
file(REMOVE_RECURSE ${WORK_DIR})
set(step COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix OUTPUT_QUIET ${step})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
                        -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DGARMENTFIT_SANITIZE=${SANITIZE} ${step})
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build ${step})
execute_process(COMMAND ${WORK_DIR}/build/consumer ${ARGUMENTS} ${step})
if(EXISTS ${WORK_DIR}/prefix/bin/garmentfit)  # the installed program finds its library
    execute_process(COMMAND ${WORK_DIR}/prefix/bin/garmentfit --version ${step})
endif()
