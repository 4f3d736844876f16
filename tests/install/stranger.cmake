# Configures, builds and runs tests/install/consumer in WORK_DIR, against a fresh installation of
# BUILD_DIR (VARIANT find_package) or with SOURCE_DIR as a part of it (VARIANT add_subdirectory).
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " line "${ARGN}")
    message(FATAL_ERROR "${line}\n${output}\nexit status: ${status}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text)
  string(FIND "${output}" "${text}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "expected '${text}' in:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
if(VARIANT STREQUAL "find_package")
  set(prefix "${WORK_DIR}/prefix")
  run(${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${prefix}")
  set(perimode "-DCMAKE_PREFIX_PATH=${prefix}")
  set(build_type "${BUILD_TYPE}")
else()
  set(perimode "-DPERIMODE_SOURCE_DIR=${SOURCE_DIR}" -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_DEBUG=-O0)
  set(build_type Debug)  # the quickest to compile
endif()

run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${WORK_DIR}/build" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
    "-DCMAKE_BUILD_TYPE=${build_type}" ${perimode})
run(${CMAKE_COMMAND} --build "${WORK_DIR}/build" --target consumer --parallel 2)
run("${WORK_DIR}/build/consumer")
expect("2509.113194 Hz")

if(VARIANT STREQUAL "find_package")
  run("${prefix}/bin/perimode" --version)
  expect("${VERSION}")
endif()
