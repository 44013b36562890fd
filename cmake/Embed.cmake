# sky_embed(TARGET ROOT dir NAMESPACE ns): every text file below ROOT, compiled into the program, so that it runs from
# anywhere. Gives a header "TARGET.hpp" with  std::string_view ns::source(std::string_view path)  (empty if unknown).
function(sky_embed target)
    cmake_parse_arguments(ARG "" "ROOT;NAMESPACE" "" ${ARGN})
    set(root ${PROJECT_SOURCE_DIR}/${ARG_ROOT})
    file(GLOB_RECURSE files RELATIVE ${root} CONFIGURE_DEPENDS ${root}/*.glsl ${root}/*.comp ${root}/*.frag ${root}/*.vert
                                                               ${root}/*.csv)
    list(TRANSFORM files PREPEND ${root}/ OUTPUT_VARIABLE paths)
    set(directory ${PROJECT_BINARY_DIR}/embedded/${target})
    string(REPLACE ";" "|" fileList "${files}")
    add_custom_command(
        OUTPUT ${directory}/${target}.cpp ${directory}/${target}.hpp
        COMMAND ${CMAKE_COMMAND} -DROOT=${root} "-DFILES=${fileList}" -DNAMESPACE=${ARG_NAMESPACE} -DNAME=${target}
                -DDIRECTORY=${directory} -P ${PROJECT_SOURCE_DIR}/cmake/EmbedScript.cmake
        DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/EmbedScript.cmake
        VERBATIM)
    add_library(${target} STATIC ${directory}/${target}.cpp ${directory}/${target}.hpp)
    target_include_directories(${target} PUBLIC ${directory})
endfunction()
