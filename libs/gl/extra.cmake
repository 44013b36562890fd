# OpenGL functions come from glad, generated at build time. `--mx`: one table of functions per context, no global state;
# `--merge`: one table for desktop GL and GLES; `--reproducible`: use the bundled registry, no network.
find_program(GLAD_EXECUTABLE glad REQUIRED DOC "glad2 loader generator (Debian: python3-glad)")
set(sky_glad_directory ${PROJECT_BINARY_DIR}/glad)
set(sky_glad_extensions GL_KHR_debug,GL_KHR_robustness,GL_ARB_robustness,GL_EXT_robustness,GL_EXT_disjoint_timer_query)
string(APPEND sky_glad_extensions ,GL_EXT_color_buffer_float,GL_EXT_color_buffer_half_float,GL_OES_texture_float_linear)
add_custom_command(
    OUTPUT ${sky_glad_directory}/src/gl.c ${sky_glad_directory}/include/glad/gl.h
    COMMAND ${GLAD_EXECUTABLE} --quiet --reproducible --api gl:core=4.3,gles2=3.0 --merge
            --extensions ${sky_glad_extensions} --out-path ${sky_glad_directory} c --mx
    DEPENDS ${CMAKE_CURRENT_LIST_DIR}/extra.cmake
    COMMENT "Generating the OpenGL loader"
    VERBATIM)
# A C library of its own, so that our warnings stay ours.
add_library(sky_glad STATIC ${sky_glad_directory}/src/gl.c ${sky_glad_directory}/include/glad/gl.h)
target_include_directories(sky_glad SYSTEM PUBLIC ${sky_glad_directory}/include)
# Libraries above sky_gl include the generated header too: the target orders their builds after the generation.
add_dependencies(sky_gl sky_glad)
target_link_libraries(sky_gl PUBLIC sky_glad PRIVATE ${CMAKE_DL_LIBS})
