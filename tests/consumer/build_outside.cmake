# Installs the built core into a fresh prefix, then configures, builds and runs the outside project against it.
function(run_step)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK_FOLDER})
set(prefix ${WORK_FOLDER}/prefix)
run_step(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --config ${CONFIG} --component core --prefix ${prefix})
run_step(${CMAKE_COMMAND} -S ${PROJECT_FOLDER} -B ${WORK_FOLDER}/build -G ${GENERATOR}
         -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS=${FLAGS}
         -D CMAKE_PREFIX_PATH=${prefix})
run_step(${CMAKE_COMMAND} --build ${WORK_FOLDER}/build)
run_step(${WORK_FOLDER}/build/sphere_area)
