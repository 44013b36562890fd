target_link_libraries(sky_solver PUBLIC sky_shaders Threads::Threads)
target_compile_definitions(sky_solver PRIVATE SKY_VERSION="${PROJECT_VERSION}")
