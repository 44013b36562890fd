target_link_libraries(sky_solver PUBLIC sky_shaders Threads::Threads)
