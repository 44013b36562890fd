# The colour matching functions are compiled in.
target_link_libraries(sky_physics PRIVATE sky_data)
