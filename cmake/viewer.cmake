# Bundles viewer/ (three.js, pinned by its lock file) with esbuild and turns the script into a source file.
# Without Node and npm the program is built all the same and says that `view` is absent.
find_program(TRIMLOOP_NPM npm)
find_program(TRIMLOOP_NODE NAMES node nodejs)
set(viewer_source ${CMAKE_CURRENT_BINARY_DIR}/viewer_script.cpp)
if(TRIMLOOP_NPM AND TRIMLOOP_NODE)
  set(viewer_build ${CMAKE_CURRENT_BINARY_DIR}/viewer)
  set(viewer_dir ${PROJECT_SOURCE_DIR}/viewer)
  add_custom_command(
    OUTPUT ${viewer_source}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${viewer_build}/src
    COMMAND ${CMAKE_COMMAND} -E copy ${viewer_dir}/package.json ${viewer_dir}/package-lock.json ${viewer_dir}/.npmrc ${viewer_build}
    COMMAND ${CMAKE_COMMAND} -E copy ${viewer_dir}/src/viewer.js ${viewer_build}/src
    COMMAND ${CMAKE_COMMAND} -E chdir ${viewer_build} ${TRIMLOOP_NPM} ci --ignore-scripts --silent
    COMMAND ${CMAKE_COMMAND} -E chdir ${viewer_build} ${TRIMLOOP_NPM} run --silent build
    COMMAND ${CMAKE_COMMAND} -DINPUT=${viewer_build}/dist/viewer.js -DOUTPUT=${viewer_source}
            -DFUNCTION=viewer_script -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${viewer_dir}/package.json ${viewer_dir}/package-lock.json ${viewer_dir}/src/viewer.js
            ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    COMMENT "Bundling the viewer" VERBATIM)
else()
  message(STATUS "Node or npm not found: trimloop will be built without `view`")
  file(WRITE ${viewer_source}.in "#include \"cli/viewer_script.h\"\nstd::string_view trimloop::cli::viewer_script() { return {}; }\n")
  configure_file(${viewer_source}.in ${viewer_source} COPYONLY)
endif()
